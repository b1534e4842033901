// The page: what is loaded, checked and saved, and what its buttons and lists do.
import { Drawing } from "./drawing.js";
import { Form, PROPOSED, made } from "./form.js";
import { distance, moved, nearestOn, round } from "./geometry.js";
import { Plan } from "./plan.js";
import { Tools } from "./tools.js";

const PAUSE = 300; // milliseconds without an edit before the plan is checked and kept
const KINDS = ["corridor", "area", "turning_point", "room", "door", "landmark", "route", "other"];
const HALF_DOOR = 0.45; // metres
const AT_WALL = 0.6; // metres from a wall within which things stand against it
const PREFIX = { turning_point: "tp", landmark: "thing" };
const token = document.querySelector("meta[name=csrf-token]").content;
const at = (id) => document.getElementById(id);
const say = (words) => { at("status").textContent = words; };
const numbered = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

const plan = new Plan(() => changed());
const drawing = new Drawing(at("plan"));
let [form, problems, names, waiting, isChecking] = [null, [], "", 0, false];
let [picture, measured, replaces] = [null, null, ""];
const settings = () => ({ width: Math.max(0.1, at("width").valueAsNumber || 2), snaps: at("snaps").checked });
const tools = new Tools({ drawing, plan, settings, say, drawn, changed: () => {
  document.querySelectorAll("[data-tool]").forEach((button) =>
    button.setAttribute("aria-pressed", button.dataset.tool === tools.tool));
} });

// The server ------------------------------------------------------------------------------

async function send(path, body, options = {}) {
  const headers = { "content-type": "application/json", "x-csrf-token": token };
  const reply = await fetch(path, { method: "POST", headers, body: JSON.stringify(body), ...options });
  const isJson = reply.headers.get("content-type")?.includes("json");
  const told = isJson ? await reply.json() : { problem: "The editor refused this. Load the page again." };
  if (!reply.ok) throw Object.assign(new Error(told.problem), { status: reply.status });
  return told;
}

// Do something on the server, and say when that did not work.
async function tried(act) {
  try {
    return await act();
  } catch (error) {
    const isGone = error instanceof TypeError;
    say(isGone ? "The editor does not answer. Is it still running? Nothing is lost while this page is open." : error.message);
    return undefined;
  }
}

async function check() {
  if (isChecking) return;
  isChecking = true;
  const { state, base } = plan;
  // What was saved while this was on its way is checked once more.
  const isOld = () => plan.base !== base || plan.state.features !== state.features || plan.state.members !== state.members;
  try {
    showProblems(await send("/check", plan.message()));
  } catch (error) {
    if (!isOld() && error.status === 409) await follow(error);
    else if (!isOld()) await tried(() => { throw error; });
  }
  isChecking = false;
  if (isOld()) waitAndCheck();
}

function waitAndCheck() {
  clearTimeout(waiting);
  at("checked").textContent = "…";
  waiting = setTimeout(check, PAUSE);
}

// Go on from what the file says now; it is only replaced when somebody says so.
async function follow(error) {
  const told = await tried(() => send("/plan", undefined, { method: "GET" }));
  if (told) plan.follow(told);
  replaces = error.message;
  changed();
}

function askWhetherToReplace() {
  at("conflict-words").textContent = replaces;
  if (!at("conflict").open) at("conflict").showModal();
}

// What is typed but not left yet is part of the plan too.
function leaveField() {
  const field = document.activeElement;
  field.blur();
  field.focus();
}

// Return the place of a feature, -1 for the plan itself, whose JSON as it was typed cannot be read.
function unreadAt() {
  const { members, features } = plan.state;
  const found = [members, ...features].findIndex((each) => form.unread.has(each));
  return found < 0 ? null : found - 1;
}

async function save() {
  if (replaces) {
    askWhetherToReplace();
    return;
  }
  leaveField();
  const { state } = plan;
  const place = unreadAt();
  if (place !== null) {
    plan.select(place);
    say("Not saved: correct the JSON first that was typed here.");
    return;
  }
  try {
    const { base } = await send("/save", plan.message());
    plan.take(base, state);
    at("draft").hidden = true;
    say("Saved.");
    changed();
  } catch (error) {
    if (error.status === 409) {
      await follow(error);
      askWhetherToReplace();
    } else await tried(() => { throw error; });
  }
}

// What is drawn ---------------------------------------------------------------------------

async function drawn(tool, places) {
  if (tool === "measure") {
    measured = places;
    if (picture) at("measured").showModal();
    else say("There is no picture beneath: begin with --picture.");
    return;
  }
  const feature = fresh(tool, places);
  const proposed = PROPOSED[tool] && await tried(() => send("/propose", { ...plan.message(), feature }));
  plan.add(`draw ${plan.state.features.length}`, ...(proposed?.features ?? [feature]));
  say(`${plan.feature.id} drawn.`);
  if (tool !== "corridor" && tool !== "landmark") tools.use("select");
}

function fresh(kind, places) {
  const route = plan.freeName("R");
  const thing = form.forms.new_thing;
  const [place, heading] = kind === "landmark" ? standing(places[0], thing.size_m[1]) : [];
  const floor = { name: null, floor_material: "carpet", wall_material: "plaster" };
  const properties = {
    corridor: floor,
    area: { ...floor, open_air: false },
    turning_point: { name: null, shape: "corner", exits: [] },
    room: { name: "Room", use: "office" },
    door: { room: null, style: "wood", color: "brown", label: null, state: "closed" },
    landmark: { ...thing, color: null, name: null, text: null, heading_deg: heading },
    route: { route, role: "reference", start_heading_deg: 0, goal: "the goal", goal_landmark: "",
      turns: [], note: "" },
  }[kind];
  const geometry = {
    door: () => ({ type: "LineString", coordinates: doorAt(places[0]) }),
    landmark: () => ({ type: "Point", coordinates: place }),
    route: () => ({ type: "LineString", coordinates: places }),
  }[kind]?.() ?? { type: "Polygon", coordinates: [[...places, places[0]]] };
  const id = kind === "route" ? `route_${route.toLowerCase()}_reference` : plan.freeName(`${PREFIX[kind] ?? kind}_`);
  return { type: "Feature", id, geometry, properties: { kind, ...properties } };
}

// Return the wall nearest to a place, where on it that is, and how far away.
function wallAt(place) {
  const found = tools.walls.map((side) => {
    const foot = nearestOn(place, side);
    return { side, foot, gap: distance(place, foot) };
  });
  return found.reduce((best, each) => (each.gap < best.gap ? each : best), { gap: Infinity });
}

// Return a door along the wall nearest to a place.
function doorAt(place) {
  const { side: [start, end] = [place, moved(place, [2 * HALF_DOOR, 0])], foot = place } = wallAt(place);
  const long = distance(start, end);
  const middle = Math.max(HALF_DOOR, Math.min(distance(start, foot), long - HALF_DOOR));
  return [-HALF_DOOR, HALF_DOOR].map((by) =>
    [0, 1].map((n) => round(start[n] + ((end[n] - start[n]) / long) * (middle + by))));
}

// Return where a thing stands and the way it faces: near a wall, with its back to it.
function standing(place, depth) {
  const { foot, gap } = wallAt(place);
  if (gap > AT_WALL || gap === 0) return [place, 90];
  const out = [0, 1].map((n) => (place[n] - foot[n]) / gap);
  const degrees = Math.round((Math.atan2(out[1], out[0]) * 180) / Math.PI);
  return [moved(foot, out.map((part) => (part * depth) / 2)), (degrees + 360) % 360];
}

async function propose() {
  const message = { ...plan.message(), feature: plan.feature };
  const told = await tried(() => send("/propose", message));
  if (told && JSON.stringify(told.features[0]) !== JSON.stringify(plan.feature)) plan.replace("propose", told.features[0]);
}

async function proposeTurningPoints() {
  const told = await tried(() => send("/propose", { ...plan.message(), feature: null }));
  if (told?.features.length) plan.add("turning points", ...told.features);
  if (told) say(`${numbered(told.features.length, "turning point")} made.`);
}

// What is shown ---------------------------------------------------------------------------

function changed() {
  drawing.render(plan.state);
  const { isSaved } = plan;
  document.title = `${isSaved ? "" : "• "}${document.querySelector("h1").textContent}`;
  at("saved").textContent = isSaved ? "saved" : "not saved";
  at("undo").disabled = !plan.past.length;
  at("redo").disabled = !plan.coming.length;
  cancelAnimationFrame(changed.details);
  changed.details = requestAnimationFrame(showDetails);
  if (plan.state.features !== changed.features || plan.state.members !== changed.members) {
    ({ features: changed.features, members: changed.members } = plan.state);
    waitAndCheck();
  }
}

function showDetails() {
  const { features, selected } = plan.state;
  const worst = worstOf();
  const titles = features.map((each, n) =>
    `${{ error: "✘ ", warning: "△ " }[worst.get(each)] ?? ""}${each?.id ?? `features[${n}]`}`);
  const kinds = features.map((each) => (KINDS.includes(each?.properties?.kind) ? each.properties.kind : "other"));
  const list = at("features");
  const isPlanWrong = problems.some((each) => each.feature === "-" && each.severity === "error");
  const shown = JSON.stringify([titles, kinds, isPlanWrong]);
  if (shown !== names) {
    names = shown;
    const groups = KINDS.map((kind) => made("optgroup", { label: kind.replace("_", " ") },
      ...titles.flatMap((title, n) => (kinds[n] === kind ? [made("option", { value: n }, title)] : []))));
    list.replaceChildren(made("option", { value: -1 }, `${isPlanWrong ? "✘ " : ""}The plan itself`),
      ...groups.filter((group) => group.children.length));
  }
  list.value = selected;
  form?.show();
}

function worstOf() {
  const worst = new Map();
  for (const { feature, severity } of problems) {
    const found = plan.state.features[plan.placeOf(feature)];
    if (found && worst.get(found) !== "error") worst.set(found, severity);
  }
  return worst;
}

function showProblems(told) {
  problems = told.problems;
  const rings = told.walls;
  tools.walls = rings.flatMap((ring) => ring.slice(1).map((end, n) => [ring[n], end]));
  drawing.tellProblems(worstOf(), rings);
  for (const severity of ["error", "warning"]) {
    const found = problems.filter((each) => each.severity === severity);
    at(`${severity}s-count`).textContent = numbered(found.length, severity);
    at(`${severity}s`).replaceChildren(...found.map(({ feature, rule, message }) => {
      const button = made("button", { type: "button" }, made("b", {}, feature === "-" ? "The plan" : feature), ` ${rule}: ${message}`);
      button.addEventListener("click", () => jumpTo(feature));
      return made("li", {}, button);
    }));
  }
  at("checked").textContent = problems.length ? "" : "No problem.";
  showDetails();
}

function jumpTo(name) {
  plan.select(plan.placeOf(name));
  drawing.show([plan.feature]);
  say(plan.feature ? `${name} chosen.` : "The plan itself is chosen.");
}

// The picture beneath ---------------------------------------------------------------------

const PLACING = ["x", "y", "metres_per_pixel", "turn_deg", "opacity"];

function showPicture(placed) {
  picture = placed;
  PLACING.forEach((name) => { at(`picture-${name}`).value = round(picture[name] * 1000) / 1000; });
  drawing.layPicture(picture, [picture.width, picture.height]);
}

function layPicture(placed) {
  showPicture(placed);
  const { width, height, ...kept } = picture;
  tried(() => send("/place", kept));
}

async function loadPicture(placed) {
  const image = new Image();
  image.src = drawing.picture.dataset.source;
  await image.decode();
  drawing.picture.setAttribute("href", image.src);
  const { naturalWidth: width, naturalHeight: height } = image;
  const begun = { x: 0, y: height * 0.02, metres_per_pixel: 0.02, turn_deg: 0, opacity: 0.5 };
  showPicture({ ...(placed ?? begun), width, height });
  PLACING.forEach((name) => at(`picture-${name}`).addEventListener("change", ({ target }) => {
    if (Number.isFinite(target.valueAsNumber)) layPicture({ ...picture, [name]: target.valueAsNumber });
  }));
}

// Make what lies between the two marked points as long as it is, about the first of them.
function scalePicture() {
  const metres = at("metres").valueAsNumber;
  if (!(metres > 0)) return;
  const [start, end] = measured;
  const factor = metres / distance(start, end);
  layPicture({ ...picture, metres_per_pixel: picture.metres_per_pixel * factor,
    x: start[0] + (picture.x - start[0]) * factor, y: start[1] + (picture.y - start[1]) * factor });
  tools.use("select");
}

// The beginning ---------------------------------------------------------------------------

const acts = {
  undo: () => plan.undo(), redo: () => plan.redo(), save: () => save(),
  over: () => {
    replaces = "";
    at("conflict").close();
    save();
  },
  closer: () => drawing.zoom(1.25), farther: () => drawing.zoom(0.8),
  all: () => drawing.show(plan.state.features),
  meetings: proposeTurningPoints,
  help: () => at("keys").showModal(),
  discard: async () => {
    if (await tried(() => send("/discard", {})) !== undefined) await load();
  },
};

addEventListener("click", ({ target }) => {
  const button = target.closest("button");
  if (button?.dataset.act) acts[button.dataset.act]();
  if (button?.dataset.tool) {
    tools.use(button.dataset.tool);
    drawing.svg.focus();
  }
});
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey)) return;
  const isTyping = event.target.matches("input:not([type=checkbox]), textarea");
  const act = { s: "save", z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()];
  if (act && (act === "save" || !isTyping)) acts[act]();
  else if (event.key === "d" && plan.feature) {
    leaveField();
    plan.duplicate();
  } else return;
  event.preventDefault();
});
at("features").addEventListener("change", ({ target }) => {
  plan.select(Number(target.value));
  drawing.show([plan.feature]);
});
at("features").addEventListener("keydown", (event) => {
  if (event.key === "Delete" && plan.feature) plan.remove();
});
at("measured").addEventListener("close", () => { if (at("measured").returnValue === "take") scalePicture(); });
addEventListener("beforeunload", (event) => {
  document.activeElement.blur();
  if (!plan.isSaved || unreadAt() !== null) event.preventDefault();
});
addEventListener("pagehide", () => {
  if (!plan.isSaved) send("/check", plan.message(), { keepalive: true }).catch(() => {});
});

async function load() {
  const told = await tried(() => send("/plan", undefined, { method: "GET" }));
  if (!told) return;
  replaces = "";
  form = new Form(at("form"), told.forms, plan, propose);
  plan.begin(told);
  at("draft").hidden = !told.draft;
  at("old-draft").hidden = !(told.draft && told.is_old_draft);
  drawing.show(plan.state.features);
  if (drawing.picture.dataset.source && !picture) await loadPicture(told.picture);
  say(`${numbered(plan.state.features.length, "feature")} loaded.`);
}

load();
