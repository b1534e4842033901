// Replays the walks of an episode: one clock for all runs, driven by slider or button.
"use strict";

// The data of the runs are scripts too, and come after this one.
document.addEventListener("DOMContentLoaded", () => {
  const panels = [...document.querySelectorAll(".replay")]
    .filter((article) => window.replayData?.[article.dataset.run])
    .map((article) => new Panel(article, window.replayData[article.dataset.run]));
  const controls = document.querySelector(".controls");
  if (panels.length > 0) new Clock(controls, panels);
});

class Panel {
  constructor(article, data) {
    this.title = article.querySelector("h3").textContent;
    this.poses = [];
    for (let i = 0; i < data.poses.length; i += 4) this.poses.push(data.poses.slice(i, i + 4));
    this.events = [];
    for (let i = 0; i < data.events.length; i += 4) {
      const [time, kind, word, set] = data.events.slice(i, i + 4);
      const text = [word].flat().map((piece) => data.words[piece]).join("");
      this.events.push({ time, kind: data.kinds[kind], text, at: data.sets[set] });
    }
    this.seen = [];
    for (let i = 0; i < data.seen.length; i += 4) {
      const [time, x, y, word] = data.seen.slice(i, i + 4);
      this.seen.push({ time, x, y, label: data.words[word] });
    }
    this.isProgram = data.program;
    this.article = article;
    this.svg = article.querySelector("svg.plan");
    this.frame = this.svg.getAttribute("viewBox");
    this.now = article.querySelector(".now");
    this.lines = [...article.querySelectorAll(".worked li")];
    this.moving = article.querySelector(".moving");
    this.walked = element("path", { class: "walked" });
    this.robot = element("path", { class: "robot" });
    this.sights = element("g", {});
    this.people = [];
    for (let i = 0; i < data.people.length; i += 3) this.people.push(data.people.slice(i, i + 3));
    this.crowd = element("g", {});
    this.moving.append(...things(data.things), this.crowd, this.walked, this.sights, this.robot);
    this.now.hidden = false;
  }

  connect(longest, jump) {
    this.moveCursor = makeStrip(this.article.querySelector(".strip"), this.events, longest);
    this.markRow = makeTimeline(this.article.querySelector(".timeline"), this.events, jump);
  }

  // Shows a moment; returns what happens then, in words.
  show(time, isCloseUp) {
    const [x, y, heading] = this.poseAt(time);
    const scale = isCloseUp ? 0.5 : 1;
    const isOver = time >= this.poses.at(-1)[0];
    this.article.classList.toggle("live", !isOver);
    this.walked.setAttribute("d", isOver ? "" : this.pathUntil(time, x, y));
    this.robot.setAttribute("d", arrow(x, -y, heading, 1.1 * scale));
    this.showSeen(time, x, y, scale);
    const near = this.people.filter(([then]) => Math.abs(then - time) <= 0.5);
    this.crowd.replaceChildren(...near.map(([, east, north]) => element("circle", { class: "person", cx: east, cy: -north, r: 0.3 })));
    this.svg.setAttribute("viewBox", isCloseUp ? `${x - 12} ${-y - 8} 24 16` : this.frame);
    let number = -1;
    while (number + 1 < this.events.length && this.events[number + 1].time <= time) number += 1;
    const event = this.events[number];
    this.moveCursor(Math.min(time, this.poses.at(-1)[0]));
    this.markRow(number);
    // A call is told when it has ended; its line is at work until then.
    const atWork = (this.isProgram && this.events[number + 1]) || event;
    const current = new Set(atWork?.at ?? []);
    this.lines.forEach((line, index) => {
      line.classList.toggle("current", current.has(index));
      if (current.has(index)) line.setAttribute("aria-current", "step");
      else line.removeAttribute("aria-current");
    });
    const shown = document.createElement("time");
    shown.textContent = `${time.toFixed(1)} s`;
    this.now.replaceChildren(shown, this.tell(number));
    return `${this.title}: ${this.tell(number)}`;
  }

  // What is being done, the last thing done before, and what was seen or noted since.
  tell(number) {
    const next = this.events.slice(number + 1).find((event) => !isQuiet(event));
    if (next && ["move", "turn"].includes(next.kind)) {
      return `${this.done(number)} · doing ${next.text.split(" → ")[0]}`;
    }
    return this.done(number);
  }

  done(number) {
    const told = [];
    for (let i = number; i >= 0 && told.length < 3; i -= 1) {
      if (isQuiet(this.events[i])) continue;
      told.unshift(this.events[i].text);
      if (["move", "turn", "stop", "other"].includes(this.events[i].kind)) break;
    }
    return told.join(" · ") || "nothing yet";
  }

  poseAt(time) {
    const index = this.indexAt(time);
    const [t0, x0, y0, h0] = this.poses[index];
    const next = this.poses[index + 1];
    if (!next || next[0] <= t0) return [x0, y0, h0];
    const share = Math.min(1, Math.max(0, (time - t0) / (next[0] - t0)));
    const turn = Math.atan2(Math.sin(next[3] - h0), Math.cos(next[3] - h0));
    return [x0 + share * (next[1] - x0), y0 + share * (next[2] - y0), h0 + share * turn];
  }

  indexAt(time) {
    let low = 0;
    let high = this.poses.length - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.poses[middle][0] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  pathUntil(time, x, y) {
    const points = this.poses.slice(0, this.indexAt(time) + 1).map((pose) => `${pose[1]} ${-pose[2]}`);
    return `M${[...points, `${x} ${-y}`].join("L")}`;
  }

  // What was detected in the last two seconds, where it was seen.
  showSeen(time, x, y, scale) {
    const labels = new Map();
    for (const each of this.seen) {
      if (each.time <= time && each.time > time - 2) labels.set(each.label, each);
    }
    this.sights.replaceChildren();
    for (const { x: there, y: north, label } of labels.values()) {
      this.sights.append(
        element("path", { class: "sight", d: `M${x} ${-y}L${there} ${-north}` }),
        element("circle", { class: "seen", cx: there, cy: -north, r: 0.5 * scale }),
        element("text", { class: "label", x: there, y: -north - 0.8 * scale, "font-size": 1.5 * scale }, label),
      );
    }
  }
}

class Clock {
  constructor(controls, panels) {
    this.panels = panels;
    this.longest = Number(controls.dataset.longest);
    this.slider = controls.querySelector("input[type=range]");
    this.output = controls.querySelector("output");
    this.button = controls.querySelector(".play");
    this.speed = controls.querySelector("select");
    this.closeUp = controls.querySelector(".close-up");
    this.timer = null;
    this.times = [...new Set(panels.flatMap((panel) => panel.events.filter((e) => !isQuiet(e)).map((e) => e.time)))];
    this.times.sort((one, other) => one - other);
    const jump = (time) => { this.pause(); this.go(time); };
    for (const panel of panels) panel.connect(this.longest, jump);
    this.slider.addEventListener("input", () => jump(Number(this.slider.value)));
    this.button.addEventListener("click", () => (this.timer ? this.pause() : this.play()));
    this.closeUp.addEventListener("change", () => this.go(this.time));
    controls.querySelector(".back").addEventListener("click", () => {
      jump(this.times.findLast((time) => time < this.time - 0.01) ?? 0);
    });
    controls.querySelector(".next").addEventListener("click", () => {
      jump(this.times.find((time) => time > this.time + 0.01) ?? this.longest);
    });
    controls.hidden = false;
    this.go(this.longest);
  }

  go(time) {
    this.time = Math.min(this.longest, Math.max(0, time));
    const told = this.panels.map((panel) => panel.show(this.time, this.closeUp.checked));
    this.slider.value = this.time;
    this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(1)} seconds. ${told.join(". ")}`);
    this.output.textContent = `${this.time.toFixed(1)} of ${this.longest.toFixed(1)} s`;
  }

  // Who wants no motion gets one step a second instead of a moving picture.
  play() {
    if (this.time >= this.longest) this.go(0);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const step = still ? 1000 : 50;
    this.button.textContent = "Pause";
    this.timer = setInterval(() => {
      this.go(this.time + (step / 1000) * Number(this.speed.value));
      if (this.time >= this.longest) this.pause();
    }, step);
  }

  pause() {
    clearInterval(this.timer);
    this.timer = null;
    this.button.textContent = "Play";
  }
}

// What was left in the way, as rectangles; the length lies across the front.
function things(flat) {
  const made = [];
  for (let i = 0; i < flat.length; i += 5) {
    const [x, y, heading, length, depth] = flat.slice(i, i + 5);
    const turn = `translate(${x} ${-y}) rotate(${(-heading * 180) / Math.PI})`;
    made.push(element("rect", { class: "left-there", x: -depth / 2, y: -length / 2, width: depth, height: length, transform: turn }));
  }
  return made;
}

function arrow(x, y, heading, size) {
  const corner = (angle, reach) =>
    `${(x + reach * size * Math.cos(heading + angle)).toFixed(2)} ${(y - reach * size * Math.sin(heading + angle)).toFixed(2)}`;
  return `M${corner(0, 1.3)}L${corner(2.5, 1)}L${corner(Math.PI, 0.45)}L${corner(-2.5, 1)}Z`;
}
