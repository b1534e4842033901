// The plan as SVG, y down: features, walls, problems, what is chosen and what is being drawn.
import { footprint, linesOf, middleOf } from "./geometry.js";

const SVG = "http://www.w3.org/2000/svg";
const LAYERS = ["room", "area", "corridor", "turning_point", "other", "door", "route", "landmark"];
const FAR = 14; // pixels a metre below which names would only be specks
const [CLOSEST, FARTHEST] = [400, 1];
const MARKS = { error: "✘", warning: "△" };

const made = (name, attributes = {}, parent = null) => {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent?.append(element);
  return element;
};
const data = (lines, isClosed) => lines
  .map((line) => `M${line.map(([x, y]) => `${x} ${-y}`).join("L")}${isClosed ? "Z" : ""}`)
  .join("");

export class Drawing {
  constructor(svg) {
    this.svg = svg;
    this.view = { x: 8, y: 4, scale: 30 };
    this.shown = new Map();
    this.featureOf = new WeakMap();
    this.picture = svg.querySelector("image");
    const group = (id) => made("g", { id }, svg);
    this.layers = Object.fromEntries(LAYERS.map((kind) => [kind, group(`layer-${kind}`)]));
    this.walls = made("path", { id: "walls" }, svg);
    [this.names, this.marks, this.chosen, this.sketch] =
      ["names", "marks", "chosen", "sketch"].map(group);
    new ResizeObserver(() => this.applyView()).observe(svg);
  }

  applyView() {
    const { width, height } = this.svg.getBoundingClientRect();
    const { x, y, scale } = this.view;
    const [across, down] = [width / scale, height / scale];
    this.svg.setAttribute("viewBox", `${x - across / 2} ${-y - down / 2} ${across} ${down}`);
    this.svg.style.setProperty("--pixel", 1 / scale);
    this.svg.classList.toggle("far", scale < FAR);
  }

  place({ clientX, clientY }) {
    const box = this.svg.getBoundingClientRect();
    const { x, y, scale } = this.view;
    return [x + (clientX - box.left - box.width / 2) / scale,
      y - (clientY - box.top - box.height / 2) / scale];
  }

  zoom(factor, about = [this.view.x, this.view.y]) {
    const scale = Math.min(CLOSEST, Math.max(FARTHEST, this.view.scale * factor));
    const part = this.view.scale / scale;
    const [x, y] = ["x", "y"].map((axis, n) => about[n] + (this.view[axis] - about[n]) * part);
    this.view = { x, y, scale };
    this.applyView();
  }

  pan(by) {
    this.view = { ...this.view, x: this.view.x - by[0], y: this.view.y - by[1] };
    this.applyView();
  }

  // Show all of some features; what is in sight stays where it is.
  show(features) {
    const places = features.flatMap((feature) => linesOf(feature).flat());
    const { x: left, y: up, width: across, height: down } = this.svg.viewBox.baseVal;
    const isSeen = ([x, y]) => x > left && x < left + across && -y > up && -y < up + down;
    if (!places.length || (features.length === 1 && places.every(isSeen))) return;
    const [x, y] = [0, 1].map((axis) => places.map((place) => place[axis]));
    const [west, east] = [Math.min(...x), Math.max(...x)];
    const [south, north] = [Math.min(...y), Math.max(...y)];
    const { width, height } = this.svg.getBoundingClientRect();
    const fits = Math.min(width / (east - west + 4), height / (north - south + 4));
    const scale = Math.min(features.length > 1 ? fits : Math.min(fits, this.view.scale), 60);
    this.view = { x: (west + east) / 2, y: (south + north) / 2, scale };
    this.applyView();
  }

  render({ features, selected, corner }) {
    const shown = new Map();
    for (const feature of features) {
      if (!feature || typeof feature !== "object") continue;
      shown.set(feature, this.shown.get(feature) ?? this.make(feature));
    }
    for (const [feature, elements] of this.shown) {
      if (!shown.has(feature)) elements.forEach((element) => element.remove());
    }
    this.shown = shown;
    this.choose(features[selected], corner);
  }

  make(feature) {
    const { kind, name, heading_deg: degrees, size_m: size } = feature.properties ?? {};
    const heading = Number.isFinite(degrees) ? degrees : 0;
    const layer = this.layers[kind] ? kind : "other";
    const isLine = feature.geometry?.type === "LineString";
    let lines = linesOf(feature);
    if (feature.geometry?.type === "Point" && lines.length) {
      const [[place]] = lines;
      const sizes = Array.isArray(size) && size.every(Number.isFinite) ? size : [0.5, 0.5];
      const corners = footprint(place, sizes, heading);
      const front = footprint(place, [0, sizes[1] + 0.3], heading)[0];
      lines = [corners, [place, front]];
    }
    const group = made("g", { class: `feature ${layer}` }, this.layers[layer]);
    if (isLine) made("path", { class: "reach", d: data(lines) }, group);
    made("path", { class: "ink", d: data(lines, !isLine) }, group);
    this.featureOf.set(group, feature);
    const middle = typeof name === "string" && middleOf(feature);
    if (!middle) return [group];
    const text = made("text", { x: middle[0], y: -middle[1] }, this.names);
    text.textContent = name;
    return [group, text];
  }

  choose(feature, corner) {
    this.chosen.replaceChildren();
    this.svg.querySelector(".selected")?.classList.remove("selected");
    this.shown.get(feature)?.[0].classList.add("selected");
    linesOf(feature).forEach((line, row) => line.forEach(([x, y], n) => {
      const isChosen = corner?.[0] === row && corner[1] === n;
      const attributes = { cx: x, cy: -y, class: isChosen ? "corner now" : "corner" };
      Object.assign(made("circle", attributes, this.chosen).dataset, { row, n });
    }));
  }

  tellProblems(worst, walls) {
    this.marks.replaceChildren();
    this.svg.querySelectorAll(".error, .warning")
      .forEach((element) => element.classList.remove("error", "warning"));
    for (const [feature, severity] of worst) {
      this.shown.get(feature)?.[0].classList.add(severity);
      const middle = middleOf(feature);
      if (!middle) continue;
      const at = { x: middle[0], y: -middle[1], class: severity };
      made("text", at, this.marks).textContent = MARKS[severity];
    }
    this.walls.setAttribute("d", data(walls, true));
  }

  // Show what is being drawn: its corners, where the next place would be, and a word on it.
  outline(corners, isClosed, next, words) {
    this.sketch.replaceChildren();
    if (!next) return;
    made("path", { d: data([corners], isClosed) }, this.sketch);
    made("circle", { cx: next[0], cy: -next[1] }, this.sketch);
    made("text", { x: next[0], y: -next[1] }, this.sketch).textContent = words;
  }

  layPicture({ x, y, metres_per_pixel: scale, turn_deg: turn, opacity }, [width, height]) {
    const attributes = { width: width * scale, height: height * scale, opacity,
      transform: `translate(${x} ${-y}) rotate(${-turn})` };
    for (const [key, value] of Object.entries(attributes)) this.picture.setAttribute(key, value);
  }
}
