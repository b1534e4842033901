// What pointer and keys do on the plan: choosing and moving, or placing what a tool draws.
import { corridorAlong, distance, linesOf, rectangle, round, sidesOf, snapped }
  from "./geometry.js";

const NEAR = 9; // pixels
const DRAGGED = 5; // pixels
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
// How many places end a drawing by themselves, and whether a line closes.
export const TOOLS = {
  select: { key: "v", least: 0, most: 0 },
  corridor: { key: "c", least: 2, most: 2 },
  area: { key: "a", least: 2, closes: true },
  room: { key: "r", least: 2, closes: true },
  turning_point: { key: "p", least: 2, closes: true },
  door: { key: "d", least: 1, most: 1 },
  landmark: { key: "t", least: 1, most: 1 },
  route: { key: "w", least: 2 },
  measure: { key: "m", least: 2, most: 2 },
};

export class Tools {
  constructor({ drawing, plan, settings, say, drawn, changed }) {
    Object.assign(this, { drawing, plan, settings, say, drawn, changed });
    [this.tool, this.places, this.next, this.drag, this.walls] = ["select", [], null, null, []];
    const { svg } = drawing;
    svg.addEventListener("pointerdown", (event) => this.press(event));
    svg.addEventListener("pointermove", (event) => this.hover(event));
    svg.addEventListener("pointerup", (event) => this.release(event));
    svg.addEventListener("pointercancel", () => this.end());
    svg.addEventListener("keydown", (event) => this.type(event));
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      drawing.zoom(event.deltaY < 0 ? 1.2 : 1 / 1.2, drawing.place(event));
    }, { passive: false });
  }

  use(tool) {
    this.tool = tool;
    this.end();
    this.changed();
  }

  end() {
    [this.places, this.next, this.drag] = [[], null, null];
    this.drawing.outline();
  }

  // Snapping ------------------------------------------------------------------------------

  // Collect once for each gesture where places may snap to.
  ends(follows = [], left = null) {
    const others = this.plan.state.features.filter((each) => each !== left);
    // What is put at a wall finds it by itself.
    const isFree = this.tool === "door" || this.tool === "landmark";
    const corners = isFree ? [] : others.flatMap((each) => linesOf(each).flat());
    const sides = isFree ? [] : others.flatMap(sidesOf);
    return { corners, sides, follows };
  }

  snap(place, event, ends) {
    if (event.altKey || !this.settings().snaps) return place.map(round);
    return snapped(place, { ...ends, reach: NEAR / this.drawing.view.scale });
  }

  // The pointer ---------------------------------------------------------------------------

  press(event) {
    const { drawing, plan } = this;
    const at = drawing.place(event);
    const from = [event.clientX, event.clientY];
    drawing.svg.setPointerCapture(event.pointerId);
    if (event.button === 1) event.preventDefault();
    if (event.button === 1 || event.shiftKey) {
      this.drag = { kind: "pan", at, from };
      return;
    }
    if (event.button) return;
    if (this.tool !== "select") {
      this.drag = { kind: "draw", from, before: this.places.length };
      this.putAt(event);
      return;
    }
    const { row, n } = event.target.dataset ?? {};
    if (event.target.classList.contains("corner")) {
      plan.select(plan.state.selected, [Number(row), Number(n)]);
      this.begin("corner", at, from);
      return;
    }
    const feature = drawing.featureOf.get(event.target.closest(".feature"));
    const place = plan.state.features.indexOf(feature);
    const isChosen = place >= 0 && place === plan.state.selected;
    if (isChosen) this.begin("move", at, from);
    else this.drag = { kind: "pan", at, from, choice: place };
  }

  begin(kind, at, from) {
    const { feature, state } = this.plan;
    const lines = linesOf(feature);
    const [row, n] = kind === "corner" ? state.corner : [0, 0];
    const follows = kind === "corner" ? [lines[row].at(n - 1), lines[row][(n + 1) % lines[row].length]] : [];
    this.drag = { kind, at, from, start: lines[row][n], ends: this.ends(follows, feature),
      label: `drag ${performance.now()}`, done: [0, 0] };
  }

  hover(event) {
    const at = this.drawing.place(event);
    const { drag } = this;
    if (!drag || drag.kind === "draw") {
      if (this.tool !== "select") this.point(this.snap(at, event, this.ends(this.places.slice(-1))));
      return;
    }
    const isFar = distance(drag.from, [event.clientX, event.clientY]) > DRAGGED;
    if (!drag.isFar && !isFar) return;
    drag.isFar = true;
    const by = at.map((value, n) => value - drag.at[n]);
    if (drag.kind === "pan") this.drawing.pan(by);
    else {
      const wanted = drag.start.slice(0, 2).map((value, n) => value + by[n]);
      const now = this.snap(wanted, event, drag.ends);
      const whole = now.map((value, n) => round(value - drag.start[n]));
      const step = whole.map((value, n) => round(value - drag.done[n]));
      drag.done = whole;
      if (step[0] || step[1]) {
        this.plan.move(drag.label, step);
      }
    }
  }

  release(event) {
    const { drag } = this;
    this.drag = null;
    if (drag?.kind === "pan" && !drag.isFar && drag.choice !== undefined) {
      this.plan.select(drag.choice);
    }
    if (drag?.kind !== "draw" || this.places.length !== drag.before + 1) return;
    // A press that was dragged draws from there to here; a click only places its end.
    const isFar = distance(drag.from, [event.clientX, event.clientY]) > DRAGGED;
    if (isFar) this.putAt(event, drag.before === 0);
  }

  putAt(event, isDrag = false) {
    const within = NEAR / 2 / this.drawing.view.scale;
    const place = this.snap(this.drawing.place(event), event, this.ends(this.places.slice(-1)));
    this.put(place, { within, isDrag });
  }

  // Placing -------------------------------------------------------------------------------

  point(place) {
    this.next = place;
    const last = this.places.at(-1);
    const isBox = TOOLS[this.tool].closes && this.places.length === 1;
    const sides = last && [0, 1].map((n) => Math.abs(place[n] - last[n]).toFixed(2));
    const words = isBox ? `${sides.join(" × ")} m` : last ? `${distance(last, place).toFixed(2)} m` : "";
    this.drawing.outline(this.cornersOf([...this.places, place]), this.tool !== "route", place, words);
  }

  cornersOf(places) {
    if (places.length !== 2) return places;
    if (this.tool === "corridor") return corridorAlong(...places, this.settings().width);
    return TOOLS[this.tool].closes ? rectangle(...places) : places;
  }

  // Take a place; one within some metres of the last or the first ends what is drawn.
  put(place, { within = 1e-6, isDrag = false } = {}) {
    const { least, most } = TOOLS[this.tool];
    const isOn = (other) => other && distance(other, place) <= within;
    const ends = isOn(this.places.at(-1)) || (this.places.length > 2 && isOn(this.places[0]));
    if (ends) {
      if (this.places.length >= least) this.finish();
      return;
    }
    this.places.push(place);
    this.point(place);
    this.say(`Place ${this.places.length} at ${place.join(", ")}.`);
    const isRectangle = isDrag && TOOLS[this.tool].closes;
    if (this.places.length === most || isRectangle) this.finish();
  }

  finish() {
    const { tool } = this;
    const corners = this.cornersOf(this.places);
    this.end();
    this.drawn(tool, corners);
  }

  // Keys ----------------------------------------------------------------------------------

  type(event) {
    if (event.ctrlKey || event.metaKey) return;
    const step = ARROWS[event.key];
    const keys = {
      Enter: () => this.enter(), " ": () => this.enter(),
      Escape: () => (this.places.length ? this.end() : this.tool === "select" ? this.plan.select(-1) : this.use("select")),
      Backspace: () => this.back(), Delete: () => this.back(),
      Insert: () => this.plan.addCorner(), i: () => this.plan.addCorner(),
      ".": () => this.turnTo(1), ",": () => this.turnTo(-1),
      "+": () => this.drawing.zoom(1.25), "-": () => this.drawing.zoom(0.8),
      0: () => this.drawing.show(this.plan.state.features),
    };
    const tool = Object.keys(TOOLS).find((name) => TOOLS[name].key === event.key);
    if (step) this.arrow(step.map((value) => round(value * (event.shiftKey ? 1 : 0.1))));
    else if (keys[event.key]) keys[event.key]();
    else if (tool) this.use(tool);
    else return;
    event.preventDefault();
  }

  arrow(by) {
    const { plan, drawing } = this;
    if (this.tool !== "select") {
      const { x, y } = drawing.view;
      const from = this.next ?? [x, y].map((value) => Math.round(value * 10) / 10);
      this.point(from.map((value, n) => round(value + by[n])));
      this.say(this.next.join(", "));
    } else if (plan.feature) {
      plan.move(`arrow ${plan.state.selected} ${plan.state.corner}`, by);
      const place = linesOf(plan.feature)[plan.state.corner?.[0] ?? 0]?.[plan.state.corner?.[1] ?? 0];
      if (place) this.say(`Now at ${place.join(", ")}.`);
    } else drawing.pan(by.map((value) => -10 * value));
  }

  enter() {
    if (this.tool === "select") return;
    if (this.next) this.put(this.next);
    else this.arrow([0, 0]);
  }

  back() {
    if (this.places.length) {
      this.places.pop();
      if (this.next) this.point(this.next);
    } else if (this.plan.state.corner) {
      if (!this.plan.removeCorner()) this.say("No corner can be spared here.");
    } else if (this.plan.feature) this.plan.remove();
  }

  turnTo(by) {
    const lines = linesOf(this.plan.feature);
    const all = lines.flatMap((line, row) => line.map((_, n) => [row, n]));
    if (!all.length) return;
    const { corner } = this.plan.state;
    const now = all.findIndex(([row, n]) => corner?.[0] === row && corner[1] === n);
    const next = all.at((now + (now < 0 && by < 0 ? 0 : by) + all.length) % all.length);
    this.plan.select(this.plan.state.selected, next);
    this.say(`Corner ${next[1] + 1} at ${lines[next[0]][next[1]].join(", ")}.`);
  }
}
