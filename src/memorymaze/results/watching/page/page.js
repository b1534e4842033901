"use strict";
// Shows what the stream of news tells. Texts come from agents and models: they are only
// ever set as text.
const SVG = "http://www.w3.org/2000/svg";
const MOST = 2000;
const part = (id) => document.getElementById(id);
const path = [];
let view = [0, 0, 1, 1];

function made(name, attributes) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

function told(tag, text, name) {
  const element = document.createElement(tag);
  element.textContent = text;
  if (name) element.className = name;
  return element;
}

// All places are metres, y down.
function begin(about) {
  path.length = 0;
  part("log").replaceChildren();
  document.title = about.title;
  part("title").textContent = about.title;
  part("instruction").textContent = about.instruction;
  const [x, y, width, height] = about.plan;
  for (const [key, value] of Object.entries({ x, y, width, height })) part("plan").setAttribute(key, value);
  part("way").setAttribute("d", about.way);
  for (const id of ["way", "key-way"]) part(id).setAttribute("stroke", about.wayColor);
  view = about.view;
  const [east, south] = about.goal;
  look(east, south);
  part("goal").setAttribute("fill", about.wayColor);
  part("goal").setAttribute("transform", `translate(${east} ${south}) scale(${scale()})`);
}

// Shows more of the plan when the robot comes near the edge of what is shown.
function look(x, y) {
  const [west, north, width, height] = view;
  const left = Math.min(west, x - 3);
  const top = Math.min(north, y - 3);
  view = [left, top, Math.max(west + width, x + 3) - left, Math.max(north + height, y + 3) - top];
  part("map").setAttribute("viewBox", view.join(" "));
}

// Marks are as large on a plan of any size.
const scale = () => Math.max(view[2], view[3]) / 800;

function showStep(step) {
  part("step-heading").textContent = step.heading || "Step";
  part("step-lines").replaceChildren(
    ...step.lines.map((line, number) => {
      const atWork = step.current === null || step.current === number;
      const mark = step.lines.length > 1 && step.current === number ? "▶ " : "";
      return told("li", mark + line, atWork ? "" : "other");
    }),
  );
}

function showEvents(events) {
  const log = part("log");
  const atFoot = log.scrollHeight - log.scrollTop - log.clientHeight < 40;
  for (const event of events) {
    const row = told("li", "", event.kind);
    row.append(told("span", event.time.toFixed(1)), told("span", event.kind), told("span", event.text));
    log.append(row);
  }
  while (log.childElementCount > MOST) log.firstElementChild.remove();
  if (atFoot) log.scrollTop = log.scrollHeight;
}

function show(news) {
  const words = `${news.time.toFixed(1)} s, ${news.distance.toFixed(1)} m driven`;
  part("state").textContent = words;
  part("map-words").textContent = `The robot on the plan after ${words}`;
  const [x, y, degrees] = news.robot;
  part("robot").removeAttribute("hidden");
  look(x, y);
  part("robot").setAttribute("transform", `translate(${x} ${y}) rotate(${degrees}) scale(${scale()})`);
  path.push(...news.path);
  part("path").setAttribute("points", [...path, [x, y]].map((place) => place.join(",")).join(" "));
  part("people").replaceChildren(
    ...news.people.map(([cx, cy]) => made("circle", { class: "person", r: 7 * scale(), cx, cy })),
  );
  if (news.things) {
    const shape = "M -7 -7 H 7 V 7 H -7 Z M -7 -7 L 7 7 M -7 7 L 7 -7";
    part("things").replaceChildren(
      ...news.things.map(([tx, ty]) => made("path", { class: "thing", d: shape, transform: `translate(${tx} ${ty}) scale(${scale()})` })),
    );
    document.body.classList.add("crowded");
  }
  if (news.people.length) document.body.classList.add("crowded");
  if (news.step) showStep(news.step);
  showEvents(news.events);
}

const stream = new EventSource("news");
stream.onmessage = (message) => {
  const news = JSON.parse(message.data);
  if (news.about) begin(news.about);
  else if (news.over) {
    stream.close();
    part("over").textContent = news.over;
    part("log").scrollTop = part("log").scrollHeight;
    document.body.dataset.over = "true";
  } else show(news);
};
stream.onerror = () => {
  part("over").textContent = "Not connected: the run has ended.";
  stream.close();
};
