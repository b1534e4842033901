"use strict";
// Asks for news of the robot and shows them. Texts come from visitors and agents: they
// are only ever set as text.
const SVG = "http://www.w3.org/2000/svg";
const MOST_EVENTS = 1500;
const part = (id) => document.getElementById(id);
const visit = part("visit");
const address = `/visits/${visit.dataset.visit}`;
const token = document.querySelector('meta[name="csrf-token"]').content;
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const STATUS = {
  opening: "The robot opens its eyes. That takes some seconds.",
  ready: "The robot is ready and listens.",
  walking: "The robot is on its way.",
  over: "The walk is over. You may tell the way again.",
};
let view = visit.dataset.view.split(" ").map(Number);
let walk = -1;
let known = 0;
let state = "";
let drawn = 0;
let drawnAt = 0;
let path = [];
let names = [];
let isOver = false;

function made(tag, text, name) {
  const element = document.createElement(tag);
  element.textContent = text;
  if (name) element.className = name;
  return element;
}

function shape(tag, attributes) {
  const element = document.createElementNS(SVG, tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

const setText = (id, text) => {
  if (part(id).textContent !== text) part(id).textContent = text;
};
const percent = (share) => `${Math.round(100 * share)}%`;

// Marks are as large on a plan of any size.
const scale = () => Math.max(view[2], view[3]) / 640;
const placed = (element, x, y, degrees = 0) =>
  element.setAttribute("transform", `translate(${x} ${y}) rotate(${degrees}) scale(${scale()})`);

function placeMarks() {
  part("map").setAttribute("viewBox", view.join(" "));
  for (const mark of document.querySelectorAll(".mark[data-at]")) {
    const [x, y] = mark.dataset.at.split(" ");
    placed(mark, x, y, mark.dataset.turn || 0);
  }
}

// Shows more of the plan when the robot comes near the edge of what is shown.
function look(x, y) {
  const [west, north, width, height] = view;
  const left = Math.min(west, x - 3);
  const top = Math.min(north, y - 3);
  const wider = [left, top, Math.max(west + width, x + 3) - left, Math.max(north + height, y + 3) - top];
  if (wider.join() !== view.join()) {
    view = wider;
    placeMarks();
  }
}

function put(mark, x, y, degrees = 0) {
  mark.dataset.at = `${x} ${y}`;
  mark.dataset.turn = degrees;
  mark.removeAttribute("hidden");
  look(x, y);
  placed(mark, x, y, degrees);
}

function begin() {
  path = [];
  names = [];
  isOver = false;
  for (const id of ["thoughts", "events", "steps", "beside-rows", "others", "people", "things"]) part(id).replaceChildren();
  for (const id of ["verdict", "beside"]) part(id).hidden = true;
  part("lost").setAttribute("hidden", "");
  visit.classList.remove("is-lost", "crowded");
  part("walked").setAttribute("points", "");
  part("doubt-bar").style.width = "0";
  setText("belief", "It reads your words.");
}

function showMotion(news) {
  const words = `${Math.round(news.time)} s, ${Math.round(news.distance)} m walked`;
  setText("clock", words);
  const [x, y, degrees] = news.robot;
  put(part("robot"), x, y, degrees);
  path.push(...news.path);
  part("walked").setAttribute("points", [...path, [x, y]].map((place) => place.join(",")).join(" "));
  part("people").replaceChildren(
    ...news.people.map(([cx, cy]) => shape("circle", { class: "person", r: 7 * scale(), cx, cy })),
  );
  if (news.things) {
    part("things").replaceChildren(
      ...news.things.map(([tx, ty]) =>
        shape("path", { class: "thing", d: "M -7 -7 H 7 V 7 H -7 Z", transform: `translate(${tx} ${ty}) scale(${scale()})` }),
      ),
    );
  }
  visit.classList.toggle("crowded", news.people.length > 0 || part("things").childElementCount > 0);
}

function showSteps(steps) {
  part("steps").replaceChildren(
    ...steps.map((text) => {
      const row = made("li", "");
      const bar = made("span", "", "bar");
      bar.append(made("span", ""));
      row.append(made("span", text), made("span", "", "share"), bar);
      return row;
    }),
  );
}

function showBelief(belief) {
  const likeliest = belief.likeliest;
  setText("belief", `${belief.words}.`);
  const rows = [...part("steps").children];
  rows.forEach((row, number) => {
    const share = belief.steps[number] || 0;
    row.querySelector(".share").textContent = percent(share);
    row.querySelector(".bar span").style.width = `${100 * share}%`;
    row.toggleAttribute("aria-current", number === likeliest);
    if (number === likeliest) row.setAttribute("aria-current", "step");
  });
  part("doubt-bar").style.width = `${100 * belief.doubt}%`;
  setText("doubt-words", `How likely it thinks that something you told is wrong: ${percent(belief.doubt)}`);
}

const announce = (text) => setText("announced", text);

function showThoughts(thoughts) {
  const list = part("thoughts");
  for (const [time, kind, text] of thoughts) {
    const row = made("li", "");
    const words = made("span", kind === "says" ? `“${text}”` : text, kind);
    row.append(made("time", `${Math.round(time)} s`), " ", words);
    list.append(row);
    announce(kind === "says" ? `The robot says: ${text}` : text);
  }
  if (thoughts.length) list.scrollTop = list.scrollHeight;
}

function showEvents(events) {
  const list = part("events");
  for (const [time, text] of events) list.append(made("li", `${time.toFixed(1)} s  ${text}`));
  while (list.childElementCount > MOST_EVENTS) list.firstElementChild.remove();
}

function line(number) {
  const drawing = shape("svg", { viewBox: "0 0 32 10", class: "key-line", "aria-hidden": "true" });
  drawing.append(shape("path", { d: "M 1 5 H 31", class: `beside beside-${number}` }));
  return drawing;
}

function showRow(number, over) {
  const row = part("beside-rows").children[number] || part("beside-rows").appendChild(made("tr", ""));
  const title = made("th", "");
  title.scope = "row";
  title.append(line(number), names[number]);
  let cells = ["walks …", "", "", ""];
  if (over && over.from_goal === undefined) cells = [over.headline, "", "", ""];
  else if (over) {
    const sure = over.confidence === null ? "–" : percent(over.confidence);
    cells = [over.arrived ? "✔ yes" : "✘ no", `${over.from_goal} m`, `${over.walked} m`, sure];
  }
  row.replaceChildren(title, ...cells.map((text) => made("td", text)));
}

function showOver(number, over) {
  showRow(number, over);
  if (number > 0) {
    if (over.path) part("others").append(shape("path", { d: over.path, class: `beside beside-${number}` }));
    return;
  }
  isOver = true;
  const verdict = part("verdict");
  verdict.hidden = false;
  verdict.className = `notice ${over.arrived ? "arrived" : "astray"}`;
  setText("verdict-headline", `${over.arrived ? "✔" : "✘"} ${over.headline}`);
  part("verdict-sentences").replaceChildren(...(over.sentences || []).map((text) => made("p", text)));
  announce([over.headline, ...(over.sentences || [])].join(" "));
  if (over.lost) {
    visit.classList.add("is-lost");
    put(part("lost"), ...over.lost);
  }
}

function show(news) {
  if (news.sets_out) {
    names[news.number] = news.sets_out;
    showRow(news.number, null);
    part("beside").hidden = news.number === 0;
  }
  if (news.over) showOver(news.number, news.over);
  if (news.steps) showSteps(news.steps);
  if (news.robot) {
    showMotion(news);
    showThoughts(news.thoughts);
    showEvents(news.events);
  }
  if (news.belief) showBelief(news.belief);
}

function showState(told) {
  const trouble = told.state === "away";
  const walks = told.state === "walking";
  const words = trouble ? `${told.trouble} Tell it the way again to have another one.` : STATUS[told.state];
  part("blind").hidden = !told.blind;
  setText("blind", told.blind && `There are no pictures of its camera: ${told.blind}`);
  setText("status", walks && told.paused ? "The robot waits: the walk is paused." : walks && isOver ? "The others follow the same words." : words);
  part("status").classList.toggle("wrong", trouble);
  part("controls").hidden = !walks;
  part("pause").hidden = isOver;
  part("tell").hidden = walks;
  part("minds").hidden = told.walk === 0;
  part("calls").hidden = told.walk === 0;
  visit.classList.toggle("walked", told.walk > 0);
  part("pause").setAttribute("aria-pressed", String(told.paused));
  setText("pause", told.paused ? "Go on" : "Pause");
  if (told.looked_round && !part("round").src) {
    part("round").onload = () => {
      const strip = part("round-strip");
      strip.scrollLeft = (strip.scrollWidth - strip.clientWidth) / 2;
    };
    part("round").src = `${address}/round.jpg`;
  }
  const sees = told.walk > 0 && told.camera > 0;
  part("round-figure").hidden = sees || !told.looked_round;
  part("camera-figure").hidden = !sees;
  const now = performance.now();
  if (sees && told.camera !== drawn && (!calm.matches || !walks || now - drawnAt > 2000)) {
    drawn = told.camera;
    drawnAt = now;
    part("camera").src = `${address}/camera.jpg?picture=${drawn}`;
  }
  if (state === "walking" && !walks && told.walk > 0) part("verdict").scrollIntoView({ block: "nearest" });
  state = told.state;
  visit.dataset.state = state;
}

async function ask() {
  let wait = 2000;
  try {
    const answer = await fetch(`${address}/news?walk=${walk}&known=${known}`);
    if (!answer.ok) throw new Error(String(answer.status));
    const told = await answer.json();
    if (told.walk !== walk) begin();
    walk = told.walk;
    known = told.known;
    told.news.forEach(show);
    showState(told);
    wait = { walking: 200, opening: 400 }[told.state] || 2000;
    if (told.state === "away") return;
  } catch (problem) {
    setText("status", "The page has lost its robot, and looks for it …");
    part("status").classList.add("wrong");
  }
  setTimeout(ask, wait);
}

async function changePace(paused) {
  const body = new URLSearchParams({ pace: part("pace").value, paused });
  await fetch(`${address}/pace`, { method: "POST", headers: { "X-CSRF-Token": token }, body });
}

addEventListener("pagehide", () => {
  navigator.sendBeacon(`${address}/leave`, new URLSearchParams({ csrf_token: token }));
});
part("pause").addEventListener("click", () => changePace(part("pause").getAttribute("aria-pressed") !== "true"));
part("pace").addEventListener("change", () => changePace(part("pause").getAttribute("aria-pressed") === "true"));
for (const button of document.querySelectorAll("[data-example]")) {
  button.addEventListener("click", () => {
    part("text").value = button.dataset.example;
    part("text").focus();
  });
}
placeMarks();
ask();
