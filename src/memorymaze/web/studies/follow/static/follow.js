"use strict";
// Drives the robot. Each command is numbered: one that is sent twice counts once.
const part = (id) => document.getElementById(id);
const robot = part("drive").dataset.robot;
const token = document.querySelector("meta[name=csrf-token]").content;
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const buttons = [...document.querySelectorAll("[data-command]")];
const KEYS = { ArrowUp: "forward", ArrowLeft: "left", ArrowRight: "right", ArrowDown: "around" };
const FRAME = 90;
let done = 0;
let busy = true;

const pause = (milliseconds) => new Promise((then) => setTimeout(then, milliseconds));

function tell(text, wrong = false) {
  if (part("told").textContent !== text) part("told").textContent = text;
  part("told").classList.toggle("wrong", wrong);
}

async function show(told) {
  if (told.over) {
    tell("The robot's time is up. This walk is over.");
    await pause(2500);
    location.assign("/study");
    return;
  }
  const frames = calm.matches ? told.frames.slice(-1) : told.frames;
  for (const frame of frames) {
    part("camera").src = `data:image/jpeg;base64,${frame}`;
    part("camera").hidden = false;
    if (frames.length > 1) await pause(FRAME);
  }
  done = told.done;
  part("metres").textContent = Math.round(told.metres);
  tell(told.answer || (done ? "" : "The robot is ready. Drive it with the arrow keys or the buttons."));
  part("drive").dataset.done = done;
}

// Asks until there is an answer: nothing is lost when a request is.
async function ask(options) {
  for (let wait = 500; ; wait = Math.min(5000, wait * 2)) {
    try {
      const answer = await fetch(robot, options);
      // The walk is over, or nobody takes part any more: the study's page says which.
      if ([403, 404].includes(answer.status)) {
        location.assign("/study");
        return null;
      }
      const told = await answer.json();
      if (answer.ok) return told;
      tell(told.problem, true);
      if (answer.status === 409) location.reload();
      if (answer.status !== 503) return null;
    } catch {
      tell("The connection is lost; trying again.", true);
    }
    await pause(wait);
  }
}

async function act(options) {
  busy = true;
  const told = await ask(options);
  if (told) await show(told);
  busy = Boolean(told && told.over);
  for (const button of buttons) button.disabled = busy;
}

function drive(command) {
  if (busy) return;
  const body = new URLSearchParams({ number: done, command });
  act({ method: "POST", headers: { "X-CSRF-Token": token }, body });
}

for (const button of buttons) button.addEventListener("click", () => drive(button.dataset.command));
document.addEventListener("keydown", (event) => {
  const command = KEYS[event.key];
  // In questions, arrow keys move between the choices; in the words they scroll.
  if (!command || event.altKey || event.ctrlKey || event.metaKey || event.target.closest("input, #words")) return;
  event.preventDefault();
  drive(command);
});

const aloud = part("aloud");
if (aloud && "speechSynthesis" in window) {
  aloud.hidden = false;
  const rest = () => (aloud.textContent = "Read it to me");
  aloud.addEventListener("click", () => {
    if (speechSynthesis.speaking) {
      speechSynthesis.cancel();
      rest();
      return;
    }
    const speech = new SpeechSynthesisUtterance(part("words").textContent);
    speech.lang = part("words").lang;
    speech.onend = rest;
    speech.onerror = rest;
    speechSynthesis.speak(speech);
    aloud.textContent = "Stop reading";
  });
  addEventListener("pagehide", () => speechSynthesis.cancel());
}

act({});
