// The plan and its history. Features are never changed in place, so that every step back is
// a list of the same objects, and what was not touched is known by being the same.
import { linesOf, moved, withLines } from "./geometry.js";

const MERGED = 800; // milliseconds within which steps with one label are one

export class Plan {
  constructor(tell) {
    this.tell = tell;
  }

  begin({ base, plan, draft }) {
    const { features, ...members } = plan;
    const listed = Array.isArray(features) ? features : [];
    this.state = { members, features: listed, selected: -1, corner: null };
    this.take(base, this.state);
    [this.past, this.coming, this.last] = [[], [], null];
    if (draft) {
      const known = new Map(listed.map((each) => [JSON.stringify(each), each]));
      const { features: others, ...changed } = draft;
      const same = JSON.stringify(changed) === JSON.stringify(members) ? members : changed;
      const kept = others.map((each) => known.get(JSON.stringify(each)) ?? each);
      this.state = { ...this.state, members: same, features: kept };
    }
    this.tell();
  }

  // Take note that the file says something else now, which is not what is drawn here.
  follow({ base, plan }) {
    const listed = Array.isArray(plan.features) ? plan.features : [];
    const known = new Map(listed.map((each, place) => [JSON.stringify(each), place]));
    this.base = base;
    this.saved = { members: {}, features: [] };
    this.places = new Map(this.state.features
      .map((each) => [each, known.get(JSON.stringify(each))])
      .filter(([, place]) => place !== undefined));
  }

  // Take note that the file says what a state says.
  take(base, state) {
    [this.base, this.saved] = [base, state];
    this.places = new Map(state.features.map((feature, place) => [feature, place]));
  }

  get isSaved() {
    const { members, features } = this.state;
    return members === this.saved.members && features.length === this.saved.features.length
      && features.every((feature, n) => feature === this.saved.features[n]);
  }

  message() {
    const features = this.state.features.map((each) => this.places.get(each) ?? each);
    return { base: this.base, members: this.state.members, features };
  }

  get feature() {
    return this.state.features[this.state.selected];
  }

  change(label, next) {
    const now = performance.now();
    const isSoon = label.startsWith("drag") || now - this.last?.at < MERGED;
    const isMore = this.last?.label === label && isSoon;
    if (!isMore) this.past.push(this.state);
    this.last = { label, at: now };
    this.coming = [];
    this.state = { ...this.state, ...next };
    this.tell();
  }

  step(from, to) {
    if (!from.length) return false;
    to.push(this.state);
    this.state = from.pop();
    this.last = null;
    this.tell();
    return true;
  }

  undo = () => this.step(this.past, this.coming);
  redo = () => this.step(this.coming, this.past);

  select(selected, corner = null) {
    this.state = { ...this.state, selected, corner };
    this.last = null;
    this.tell();
  }

  replace(label, feature, corner = this.state.corner) {
    const features = this.state.features.with(this.state.selected, feature);
    this.change(label, { features: renamed(features, this.feature, feature), corner });
  }

  add(label, ...added) {
    const features = [...this.state.features, ...added];
    this.change(label, { features, selected: features.length - 1, corner: null });
  }

  remove() {
    const { features, selected } = this.state;
    const left = features.toSpliced(selected, 1);
    this.change(`remove ${selected}`, { features: left, selected: -1, corner: null });
  }

  duplicate() {
    const lines = linesOf(this.feature).map((line) => line.map((each) => moved(each, [1, -1])));
    const copy = { ...this.feature, id: this.freeName(`${String(this.feature.id).replace(/_\d+$/, "")}_`) };
    this.add("duplicate", lines.length ? withLines(copy, lines) : copy);
  }

  // Move the chosen corner, or else the whole feature.
  move(label, by) {
    const { corner } = this.state;
    const isMoved = (line, n) => !corner || (corner[0] === line && corner[1] === n);
    const lines = linesOf(this.feature).map((line, row) =>
      line.map((each, n) => (isMoved(row, n) ? moved(each, by) : each)));
    if (lines.length) this.replace(label, withLines(this.feature, lines));
  }

  addCorner() {
    const { corner, selected } = this.state;
    const lines = linesOf(this.feature);
    if (!corner || this.feature.geometry.type === "Point") return;
    const [row, n] = corner;
    const next = lines[row][(n + 1) % lines[row].length];
    const half = lines[row][n].map((value, axis) => (value + next[axis]) / 2);
    const longer = lines.with(row, lines[row].toSpliced(n + 1, 0, moved(half, [0, 0])));
    this.replace(`corner ${selected}`, withLines(this.feature, longer), [row, n + 1]);
  }

  removeCorner() {
    const [row, n] = this.state.corner;
    const lines = linesOf(this.feature);
    const least = this.feature.geometry.type === "Polygon" ? 3 : 2;
    if (lines[row].length <= least) return false;
    const shorter = lines.with(row, lines[row].toSpliced(n, 1));
    this.replace(`corner away ${n}`, withLines(this.feature, shorter), null);
    return true;
  }

  // Return a name with the lowest number that no feature's id has, or no route's name.
  freeName(stem) {
    const known = new Set(this.state.features.flatMap((each) => [each?.id, each?.properties?.route]));
    let number = 1;
    while (known.has(`${stem}${number}`)) number += 1;
    return `${stem}${number}`;
  }

  // Return the place of the feature that a problem names: by its id, or by its place.
  placeOf(name) {
    const byId = this.state.features.findIndex((each) => each?.id === name);
    return byId >= 0 ? byId : Number(/^features\[(\d+)\]$/.exec(name)?.[1] ?? -1);
  }
}

// Let what refers to a feature follow its new id.
function renamed(features, before, after) {
  if (!before?.id || before.id === after.id) return features;
  const other = (id) => (id === before.id ? after.id : id);
  return features.map((feature) => {
    const { room, goal_landmark: goal, exits, turns } = feature?.properties ?? {};
    const changed = {};
    if (room === before.id) changed.room = after.id;
    if (goal === before.id) changed.goal_landmark = after.id;
    if (Array.isArray(exits) && exits.some((each) => each?.to === before.id)) {
      changed.exits = exits.map((each) => ({ ...each, to: other(each.to) }));
    }
    if (Array.isArray(turns) && turns.some((each) => each?.at === before.id)) {
      changed.turns = turns.map((each) => ({ ...each, at: other(each.at) }));
    }
    if (!Object.keys(changed).length) return feature;
    return { ...feature, properties: { ...feature.properties, ...changed } };
  });
}
