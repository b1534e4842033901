// What is chosen as a form: its properties with the words that the format knows, its places
// as numbers, and its JSON.
import { corridorAlong, linesOf, middleLine, round, withLines } from "./geometry.js";

const FLOOR = ["corridor", "area", "turning_point"];
// Kinds of features that a property refers to.
const REFERS = { room: ["room"], goal_landmark: ["door", "landmark", "room"], to: FLOOR,
  at: ["turning_point"] };
const SIZES = ["length", "depth", "height"];
export const PROPOSED = { turning_point: "exits", route: "turns and goal", door: "room" };

const titled = (name) => {
  const words = name.replace(/_m$/, " (m)").replace(/_deg$/, " (degrees)").replaceAll("_", " ");
  return words[0].toUpperCase() + words.slice(1);
};
export const made = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in element && key !== "list") element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
};

export class Form {
  constructor(element, forms, plan, propose) {
    Object.assign(this, { element, forms, plan, propose });
    // What was typed as JSON and cannot be read, and why, by what it is of.
    this.unread = new Map();
  }

  // What is shown: a feature, or the members of the plan itself.
  get chosen() {
    return this.plan.state.selected < 0 ? this.plan.state.members : this.plan.feature;
  }

  show() {
    const { feature, state } = this.plan;
    const { selected, corner } = state;
    const said = JSON.stringify(this.chosen, null, 1);
    const shown = JSON.stringify([selected, corner, said]);
    if (shown === this.shown) return;
    const isKept = this.ownChange && this.selected === selected;
    [this.shown, this.selected, this.ownChange] = [shown, selected, false];
    if (isKept) {
      this.element.querySelector("textarea").value = said;
      this.element.querySelector(".wrong").textContent = "";
      return;
    }
    const focused = this.element.contains(document.activeElement) && document.activeElement.name;
    const isOpen = this.element.querySelector("details")?.open ?? false;
    const parts = state.selected < 0 ? this.partsOfPlan() : this.partsOfFeature(feature);
    this.element.replaceChildren(...parts, this.json(said, isOpen));
    if (focused) this.element.querySelector(`[name="${CSS.escape(focused)}"]`)?.focus();
  }

  // Show what the plan has instead of a number that is not taken, once the focus has gone on.
  showAnew() {
    requestAnimationFrame(() => {
      this.shown = null;
      this.show();
    });
  }

  partsOfPlan() {
    const { members } = this.plan.state;
    const commit = (name, value) => {
      this.ownChange = true;
      const now = this.plan.state.members;
      this.plan.change(`plan ${name}`, { members: { ...now, [name]: value } });
    };
    const { type, anchor, ...fields } = this.forms.plan.properties;
    return [made("h2", {}, "Plan"), ...Object.entries(fields).map(([name, schema]) =>
      this.control(name, schema, members[name], (value) => commit(name, value)))];
  }

  partsOfFeature(feature) {
    const kind = feature?.properties?.kind;
    const schema = this.forms.kinds[kind];
    const heading = made("h2", {}, schema ? `${titled(kind)} ` : "A broken feature ", made("small", {}, String(feature?.id ?? "")));
    if (!schema) return [heading, made("p", {}, "This is not of a kind that plans know. Correct its JSON, or delete it."), this.buttons()];
    const inner = schema.$defs[schema.properties.properties.$ref.split("/").at(-1)].properties;
    const commit = (name, value) => {
      const now = this.plan.feature;
      this.plan.replace(`${this.plan.state.selected} ${name}`,
        { ...now, properties: { ...now.properties, [name]: value } });
    };
    const commitHere = (name, value) => {
      // The field shows it already; what one has gone on to must not be made anew.
      this.ownChange = true;
      commit(name, value);
    };
    const fields = Object.entries(inner).filter(([name]) => name !== "length_m" || name in feature.properties);
    return [
      heading,
      this.control("id", { type: "string" }, feature.id, (id) => this.plan.replace("id", { ...this.plan.feature, id })),
      ...fields.map(([name, field]) => {
        const rows = field.items?.$ref && schema.$defs[field.items.$ref.split("/").at(-1)].properties;
        const value = feature.properties[name];
        if (rows) return this.rows(name, rows, value, (changed) => commit(name, changed));
        if (field.items) return this.sizes(name, field.items, value, commitHere);
        return this.control(name, field, value, (changed) => commitHere(name, changed));
      }),
      this.buttons(kind),
      this.places(feature, kind),
    ];
  }

  // Return a labelled control for a value of a JSON schema.
  control(name, schema, value, commit, label = titled(name)) {
    const isNullable = schema.anyOf?.some((each) => each.type === "null");
    const { type, enum: words } = schema.anyOf?.find((each) => each.type !== "null") ?? schema;
    if (words) {
      const options = words.map((word) => made("option", { value: word, selected: word === value }, word.replaceAll("_", " ")));
      const select = made("select", { name }, ...options);
      select.addEventListener("change", () => commit(select.value));
      return made("label", {}, label, select);
    }
    const input = made("input", { name, type: { boolean: "checkbox", number: "number" }[type] ?? "text" });
    if (type === "boolean") input.checked = value === true;
    else input.value = value ?? "";
    if (type === "number") input.step = "any";
    const known = this.forms.words[name] ?? this.ids(REFERS[name.split(".").at(-1)]);
    const list = known && this.list(name, known, input);
    input.addEventListener("change", () => {
      if (type === "boolean") commit(input.checked);
      else if (input.value === "" && isNullable) commit(null);
      else if (type !== "number") commit(input.value);
      else if (input.value !== "") commit(Number(input.value));
      else this.showAnew();
    });
    return made("label", { className: type === "boolean" ? "choice" : "" }, label, input, ...(list ? [list] : []));
  }

  sizes(name, schema, values, commit) {
    const now = () => this.plan.feature.properties[name] ?? [];
    const parts = SIZES.map((part, n) => this.control(`${name}.${n}`, schema, values?.[n],
      (one) => commit(name, SIZES.map((_, m) => (m === n ? one : now()[m]))), titled(part)));
    return made("fieldset", { className: "row" }, made("legend", {}, titled(name)), ...parts);
  }

  ids(kinds) {
    if (!kinds) return null;
    const of = (each) => kinds.includes(each?.properties?.kind);
    return this.plan.state.features.filter(of).map((each) => each.id);
  }

  list(name, words, input) {
    const id = `words-${name}`;
    input.setAttribute("list", id);
    return made("datalist", { id }, ...words.map((value) => made("option", { value })));
  }

  // Return a list of things with several members each, such as exits.
  rows(name, fields, values, commit) {
    const listed = Array.isArray(values) ? values : [];
    const single = titled(name).replace(/s$/, "");
    const rows = listed.map((value, n) => made("div", { className: "row" },
      ...Object.entries(fields).map(([part, schema]) => this.control(`${name}.${n}.${part}`, schema,
        value?.[part], (changed) => commit(listed.with(n, { ...value, [part]: changed })), titled(part))),
      this.button(`Remove ${single.toLowerCase()} ${n + 1}`, () => commit(listed.toSpliced(n, 1)), "✕")));
    const fresh = Object.fromEntries(Object.entries(fields).map(([part, schema]) =>
      [part, schema.enum?.[0] ?? (schema.type === "number" ? 0 : "")]));
    return made("fieldset", {}, made("legend", {}, titled(name)), ...rows,
      this.button(`Add ${single.toLowerCase()}`, () => commit([...listed, fresh])));
  }

  buttons(kind) {
    const shown = [this.button("Duplicate", () => this.plan.duplicate()),
      this.button("Delete", () => this.plan.remove())];
    if (PROPOSED[kind] && linesOf(this.plan.feature).length) shown.unshift(this.button(`Propose ${PROPOSED[kind]}`, this.propose));
    return made("div", { className: "buttons" }, ...shown);
  }

  button(label, act, text = label) {
    const button = made("button", { type: "button", name: label }, text);
    if (text !== label) button.setAttribute("aria-label", label);
    button.addEventListener("click", act);
    return button;
  }

  places(feature, kind) {
    const lines = linesOf(feature);
    const number = { type: "number" };
    const label = `${this.plan.state.selected} place`;
    const parts = [];
    const put = (changed) => this.plan.replace(label, withLines(this.plan.feature, changed));
    if (kind === "corridor" && lines[0]?.length === 4) {
      const { start, end, width } = middleLine(lines[0]);
      parts.push(this.control("width_m", number, width, (wide) => {
        if (wide > 0) put([corridorAlong(start, end, wide)]);
        else this.showAnew();
      }));
    }
    lines.forEach((line, row) => line.forEach((place, n) => {
      const { corner } = this.plan.state;
      const isNow = corner?.[0] === row && corner[1] === n;
      const fields = ["x", "y"].map((axis, m) => this.control(`${axis} ${row} ${n}`, number, place[m], (value) =>
        put(lines.with(row, line.with(n, place.with(m, round(value))))),
        `${axis} of place ${n + 1}${row ? ` in hole ${row}` : ""}`));
      parts.push(made("div", { className: isNow ? "row now" : "row" }, ...fields));
    }));
    return made("fieldset", { className: "places" }, made("legend", {}, "Places (m)"), ...parts);
  }

  // Return the JSON of what is chosen, which is taken when one leaves it, as other fields are.
  json(said, isOpen) {
    const [typed, why] = this.unread.get(this.chosen) ?? [said, ""];
    const text = made("textarea", { name: "json", value: typed, spellcheck: false });
    const wrong = made("p", { className: "wrong", role: "alert" }, why);
    const { selected } = this.plan.state;
    text.addEventListener("change", () => {
      if (this.plan.state.selected !== selected) return; // what is chosen now is not what this is of
      wrong.textContent = "";
      this.unread.delete(this.chosen);
      try {
        const value = JSON.parse(text.value);
        if (value?.constructor !== Object) throw new Error("Expected an object: { … }");
        if (selected < 0) this.plan.change("json", { members: value });
        else this.plan.replace("json", value);
      } catch (error) {
        wrong.textContent = error.message;
        this.unread.set(this.chosen, [text.value, error.message]);
      }
    });
    return made("details", { open: isOpen || why !== "" }, made("summary", {}, "As JSON, with all that is kept"),
      made("label", {}, made("span", { className: "sr" }, "JSON"), text), wrong);
  }
}
