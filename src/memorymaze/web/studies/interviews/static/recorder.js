// Records a voice; every second of it is on the tablet's disk at once.
import { change, chunksOf, forgetTake, one } from "./outbox.js";

const TYPES = ["audio/webm;codecs=opus", "audio/webm", "audio/mp4", "audio/ogg;codecs=opus"];
const SECOND = 1000;

export class Recorder {
  constructor(root, take, changed) {
    this.take = take;
    this.seconds = 0;
    this.blob = null;
    this.media = null;
    this.root = root;
    this.changed = changed;
    this.find(".record").onclick = () => this.start();
    this.find(".stop").onclick = () => this.stop();
  }

  find(selector) {
    return this.root.querySelector(selector);
  }

  get isOn() {
    return this.media !== null;
  }

  async restore() {
    const kept = await one("takes", this.take);
    await this.gather(kept);
    if (kept && !kept.stopped && this.blob) {
      this.say("The page was closed while this was recorded; what was said until then is kept. Listen to it, then go on, or record again.");
    }
  }

  async gather(kept) {
    const chunks = await chunksOf(this.take);
    this.seconds = kept ? kept.seconds : 0;
    this.blob = chunks.length ? new Blob(chunks.map((each) => each.data), { type: kept.type }) : null;
    this.show();
  }

  async start() {
    if (this.blob && !confirm("Record again? What is recorded here is removed.")) return;
    let stream;
    try {
      stream = await navigator.mediaDevices.getUserMedia({ audio: true });
    } catch (error) {
      this.say(`There is no microphone for this page (${error.name}). Allow it in the browser's settings of this site, or type what is said.`);
      return;
    }
    const type = TYPES.find((each) => MediaRecorder.isTypeSupported(each));
    const kept = { id: this.take, type: type.split(";")[0], seconds: 0, stopped: false };
    await change((stores) => {
      forgetTake(stores, this.take);
      stores.takes.put(kept);
    });
    const began = performance.now();
    let writing = Promise.resolve();
    this.blob = null;
    this.media = new MediaRecorder(stream, { mimeType: type, audioBitsPerSecond: 48000 });
    this.media.ondataavailable = ({ data }) => {
      kept.seconds = this.seconds = (performance.now() - began) / SECOND;
      writing = writing.then(() =>
        change(({ takes, chunks }) => {
          takes.put(kept);
          if (data.size) chunks.add({ take: this.take, data });
        }),
      );
      writing.catch((error) => this.say(`This tablet cannot keep the recording (${error.message}). Make room on it, or type what is said.`));
      this.show();
    };
    this.ended = new Promise((resolve) => {
      this.media.onstop = async () => {
        for (const track of stream.getTracks()) track.stop();
        kept.stopped = true;
        await writing.catch(() => {});
        await change(({ takes }) => takes.put(kept));
        this.media = null;
        await this.gather(kept);
        this.say("Recorded, and kept on this tablet.");
        resolve();
      };
    });
    this.media.start(SECOND);
    this.show();
    this.say("Recording.");
    this.watch(stream);
    this.find(".stop").focus();
  }

  async stop() {
    if (!this.media) return;
    if (this.media.state !== "inactive") this.media.stop();
    await this.ended;
    this.find(".record").focus();
  }

  watch(stream) {
    const context = new AudioContext();
    const ear = context.createAnalyser();
    const heard = new Uint8Array(ear.fftSize);
    context.createMediaStreamSource(stream).connect(ear);
    const look = () => {
      if (!this.media) return context.close();
      ear.getByteTimeDomainData(heard);
      this.find("meter").value = Math.max(...heard.map((each) => Math.abs(each - 128))) / 128;
      setTimeout(look, 100);
    };
    look();
  }

  show() {
    const whole = Math.floor(this.seconds);
    this.root.classList.toggle("on", this.isOn);
    this.find(".time").textContent = `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
    this.find(".record").textContent = this.isOn ? "Recording" : this.blob ? "Record again" : "Record";
    this.find(".record").disabled = this.isOn;
    this.find(".stop").disabled = !this.isOn;
    play(this.find("audio"), this.blob);
    this.changed();
  }

  say(text) {
    this.find(".said").textContent = text;
  }
}

export function play(audio, blob) {
  if (audio.src) URL.revokeObjectURL(audio.src);
  audio.hidden = !blob;
  if (blob) audio.src = URL.createObjectURL(blob);
  else audio.removeAttribute("src");
}
