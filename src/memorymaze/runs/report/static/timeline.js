// The timeline of an episode: a strip of marks, and a table that is made when opened.
"use strict";

const SVG = "http://www.w3.org/2000/svg";
const LANES = [
  ["moves", ["move", "turn", "stop", "other"]],
  ["saw", ["look"]],
  ["notes, model", ["note", "model", "say"]],
  ["touched", ["touch"]],
];
const LEFT = 84;

function element(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

function isQuiet(event) {
  return event.kind === "ask" || (event.kind === "look" && event.text.startsWith("saw nothing"));
}

// Draws the strip; returns a function that moves its cursor to a time.
function makeStrip(place, events, longest) {
  place.hidden = false;
  const wide = place.clientWidth || 600;
  const svg = element("svg", { viewBox: `0 0 ${wide} 80`, preserveAspectRatio: "none", "aria-hidden": "true", focusable: "false" });
  const x = (time) => LEFT + ((wide - LEFT - 6) * time) / (longest || 1);
  LANES.forEach(([title, kinds], lane) => {
    const y = 10 + lane * 20;
    svg.append(element("text", { x: 0, y: y + 4 }, title));
    svg.append(element("path", { class: "lane", d: `M${LEFT} ${y}H${wide - 6}` }));
    for (const event of events) {
      if (!kinds.includes(event.kind) || isQuiet(event)) continue;
      const tall = event.kind === "turn" || event.kind === "stop" ? 8 : 5;
      const at = x(event.time).toFixed(1);
      svg.append(element("path", { class: `tick ${kinds[0]}`, d: `M${at} ${y - tall}V${y + tall}` }));
    }
  });
  const cursor = element("path", { class: "cursor" });
  svg.append(cursor);
  place.append(svg);
  return (time) => cursor.setAttribute("d", `M${x(time).toFixed(1)} 0V80`);
}

// Prepares the table; returns a function that marks the row of an event.
function makeTimeline(details, events, jump) {
  const region = details.querySelector(".scroll");
  const box = details.querySelector("input");
  let rows = [];
  let current = -1;
  const fill = () => {
    const table = document.createElement("table");
    table.createCaption().textContent = "In the order of simulated time; a time button goes there";
    const head = table.createTHead().insertRow();
    for (const words of ["Time (s)", "Kind", "What"]) {
      const cell = document.createElement("th");
      cell.scope = "col";
      cell.textContent = words;
      head.append(cell);
    }
    const body = table.createTBody();
    rows = events.map((event) => {
      if (box.checked && isQuiet(event)) return null;
      const row = body.insertRow();
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = event.time.toFixed(1);
      button.addEventListener("click", () => jump(event.time));
      const time = document.createElement("th");
      time.scope = "row";
      time.append(button);
      row.append(time);
      row.insertCell().textContent = event.kind;
      row.insertCell().textContent = event.text;
      return row;
    });
    region.replaceChildren(table);
    mark(current);
  };
  const mark = (number) => {
    rows[current]?.classList.remove("current");
    current = number;
    rows[current]?.classList.add("current");
  };
  details.hidden = false;
  details.addEventListener("toggle", () => {
    if (details.open && rows.length === 0) fill();
  });
  box.addEventListener("change", () => {
    if (details.open) fill();
  });
  return mark;
}
