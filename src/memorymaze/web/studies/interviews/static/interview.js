// Leads through an interview. What is answered is kept on the tablet, then sent.
import { all, change, forgetTake, newId, one, open, send } from "./outbox.js";
import { prepare } from "./plan.js";
import { Recorder, play } from "./recorder.js";

const root = document.getElementById("interviews");
const study = root.dataset.study;
const sections = new Map([...root.children].map((each) => [each.dataset.step, each]));
const CURRENT = `interview of ${study}`;
const problem = document.getElementById("problem");
let interview = null;
let opened = 0;
let recorder = null;
let poll = null;

const now = () => Date.now() / 1000;
const voiceOf = (step) => `${interview.id}:${step}`;

function stepsOf(cell) {
  const routes = cell.split(", ");
  const about = (route) => ["tell", "mark", "told", "retell"].map((kind) => `${kind}.${route}`);
  return ["consent", ...routes.map((each) => `familiarity.${each}`), "scenario", ...routes.flatMap(about), "done"];
}

function shownIn(section) {
  const parts = section.querySelectorAll("[data-shown] p, [data-shown] .choice span");
  return [...parts].map((each) => each.textContent.trim()).join("\n\n");
}

// Showing a step ------------------------------------------------------------------------

async function show(step) {
  clearTimeout(poll);
  await recorder?.stop();
  recorder = null;
  for (const [name, section] of sections) section.hidden = name !== step;
  const section = sections.get(step);
  const form = section.querySelector("form");
  form.reset();
  opened = now();
  problem.hidden = true;
  document.getElementById("leave").hidden = interview === null;
  if (interview) {
    document.querySelector("[data-participant]").textContent = interview.id;
    fill(form, interview.drafts[step] ?? {});
    const [kind, route] = step.split(".");
    if (kind === "tell" || kind === "retell") await showTelling(section, step);
    if (kind === "mark") showMarking(section, route);
    if (kind === "told" && !form.elements.text.value) form.elements.text.value = errorsOf(route);
  } else {
    await showOpen();
  }
  document.title = `${section.querySelector("h1").textContent}: interview`;
  section.querySelector("h1").focus();
  scrollTo(0, 0);
}

function fill(form, draft) {
  const plan = form.plan ?? (form.dataset.marks === undefined ? null : (form.plan = prepare(form)));
  for (const name of Object.keys(draft)) {
    if (plan && !form.elements[name] && name.startsWith("kind.")) plan.addRow();
  }
  for (const [name, value] of Object.entries(draft)) {
    const field = form.elements[name];
    if (field) field.value = value;
  }
  plan?.show();
}

async function showTelling(section, step) {
  const area = section.querySelector("textarea");
  const least = Number(area.dataset.least);
  const check = () => {
    const words = area.value.split(/\s+/).filter(Boolean).length;
    const enough = words >= least || recorder?.blob || recorder?.isOn;
    area.setCustomValidity(enough ? "" : `Record what is said, or type at least ${least} words.`);
  };
  area.oninput = check;
  recorder = new Recorder(section.querySelector(".recorder"), voiceOf(step), check);
  await recorder.restore();
}

function showMarking(section, route) {
  const step = `tell.${route}`;
  const area = section.querySelector("textarea");
  const said = section.querySelector(".hearing");
  const voice = interview.voices[step];
  play(section.querySelector("audio"), voice);
  area.value ||= interview.drafts[step]?.text ?? "";
  said.textContent = voice && !area.value ? "Type it here if there is time; else later, beside the recording." : "";
  if (voice && !area.value && root.dataset.heard !== undefined) {
    hear(`/interviews/${interview.id}/transcripts/${step}`, area, said);
  }
}

// Waits for what the recogniser hears; whoever types is not disturbed.
async function hear(address, area, said) {
  try {
    const told = await (await fetch(address, { cache: "no-store" })).json();
    if (area.value) return;
    if (told.text) {
      area.value = told.text;
      said.textContent = "Written by the recogniser; please correct it.";
      return;
    }
    said.textContent = told.problem ? `The recogniser gave no text: ${told.problem}` : "The recogniser listens.";
    if (told.problem) return;
  } catch {
    said.textContent = "Without the server nothing is recognised now; it is done later.";
  }
  poll = setTimeout(hear, 2000, address, area, said);
}

function errorsOf(route) {
  const form = sections.get(`told.${route}`).querySelector("form");
  const rows = sections.get(`mark.${route}`).querySelectorAll(".failure");
  const found = [...rows]
    .map((row) => {
      const [kind, where] = [...row.querySelectorAll("select")].map((each) => each.selectedOptions[0]);
      const detail = row.querySelector("input").value.trim();
      if (!kind.value) return null;
      return `${kind.text.split(": ").slice(1).join(": ")}, at ${where.text}${detail ? `: ${detail}` : ""}`;
    })
    .filter(Boolean);
  return found.length ? [form.dataset.found, ...found.map((each) => `- ${each}`)].join("\n") : form.dataset.none;
}

async function showOpen() {
  const begun = await all("interviews");
  const list = document.querySelector("#open ul");
  document.getElementById("open").hidden = begun.length === 0;
  list.replaceChildren(
    ...begun.map((each) => {
      const row = document.createElement("li");
      const button = document.createElement("button");
      button.textContent = `Go on with ${each.id} (${each.cell})`;
      button.onclick = () => take(each);
      row.append(button);
      return row;
    }),
  );
  const cells = [...sections.get("start").querySelectorAll("input[name=cell]")];
  const least = (cell) => Number(cell.dataset.taken) + begun.filter((each) => each.cell === cell.value).length;
  cells.sort((a, b) => least(a) - least(b))[0].checked = true;
}

// Going on ------------------------------------------------------------------------------

function take(found) {
  interview = found;
  localStorage.setItem(CURRENT, found.id);
  return show(found.step);
}

function leave(step) {
  interview = null;
  localStorage.removeItem(CURRENT);
  return show(step);
}

async function goOn(step, form) {
  const fields = Object.fromEntries(new FormData(form));
  if (step === "start") {
    await take({ id: `p${newId(5)}`, cell: fields.cell, step: "consent", drafts: {}, voices: {}, told: {} });
    await change(({ interviews }) => interviews.put(interview));
    return;
  }
  if (step === "excluded") return leave("start");
  const section = sections.get(step);
  const [kind, route] = step.split(".");
  const about = { participant: interview.id, opened: Math.min(opened, now()), at: now() };
  if (!fields.shown) fields.shown = shownIn(section);
  if (kind === "consent") fields.cell = interview.cell;
  if (kind === "told") interview.told[route] = `${fields.shown}\n\n${fields.text}`;
  if (kind === "retell") fields.shown = interview.told[route];
  const records = [{ id: newId(16), step, fields, ...about }];
  const voice = voiceOf(step);
  if (recorder) {
    await recorder.stop();
    if (recorder.blob) {
      fields.recorded = "yes";
      interview.voices[step] = recorder.blob;
      records.push({ id: newId(16), step: `voice.${step}`, blob: recorder.blob, seconds: recorder.seconds, ...about });
    }
    recorder = null;
  }
  const steps = stepsOf(interview.cell);
  const ends = form.querySelector("[data-ends]:checked") !== null || kind === "done";
  interview.drafts[step] = fields;
  interview.step = steps[steps.indexOf(step) + 1];
  await change((stores) => {
    for (const each of records) stores.records.add(each);
    forgetTake(stores, voice);
    if (ends) stores.interviews.delete(interview.id);
    else stores.interviews.put(interview);
  });
  send();
  if (ends) await leave(kind === "done" ? "start" : "excluded");
  else await show(interview.step);
}

for (const [step, section] of sections) {
  const form = section.querySelector("form");
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    const button = form.querySelector("button.main:last-of-type");
    button.disabled = true;
    try {
      await goOn(step, form);
    } catch (error) {
      problem.textContent = `This could not be kept on the tablet: ${error.message}. Make room on it and press the button again.`;
      problem.hidden = false;
    } finally {
      button.disabled = false;
    }
  });
  form.addEventListener("input", () => {
    if (!interview || step !== interview.step) return;
    interview.drafts[step] = Object.fromEntries(new FormData(form));
    change(({ interviews }) => {
      interviews.put(interview);
      interviews.transaction.commit(); // also where the page is closed at once
    });
  });
}

document.querySelector("#leave button").addEventListener("click", async () => {
  const records = (await all("records")).filter((each) => each.participant === interview.id);
  const steps = stepsOf(interview.cell);
  const isSent = steps.indexOf(interview.step) > records.filter((each) => !each.blob).length;
  if (!confirm("Stop this interview and remove what is on this tablet of it?")) return;
  const gone = interview.id;
  await recorder?.stop();
  recorder = null;
  await change((stores) => {
    for (const each of records) stores.records.delete(each.order);
    for (const step of steps) forgetTake(stores, `${gone}:${step}`);
    stores.interviews.delete(gone);
  });
  await leave("start");
  await send();
  if (isSent) {
    problem.textContent = `A part of ${gone} was sent before. Remove it under Progress: press ${gone} there, then Remove everything.`;
    problem.hidden = false;
  }
});

// What is still to be sent --------------------------------------------------------------

const pending = document.getElementById("pending");
const refused = document.getElementById("refused");

function report(waiting, refusals, why) {
  const voices = waiting.filter((each) => each.blob).length;
  const count = `${waiting.length} ${waiting.length === 1 ? "thing" : "things"}`;
  const text = waiting.length
    ? `Still to be sent: ${count}, ${voices} of them ${voices === 1 ? "a recording" : "recordings"}. All is kept on this tablet. ${why}`
    : "All is sent.";
  if (pending.textContent !== text) pending.textContent = text;
  refused.hidden = refusals.length === 0;
  const remove = document.createElement("button");
  remove.textContent = "Remove these from the tablet";
  remove.onclick = async () => {
    if (!confirm("Remove for good what the server did not take?")) return;
    await change(({ records }) => refusals.forEach((each) => records.delete(each.order)));
    await send();
  };
  refused.replaceChildren(
    ...refusals.map((each) => {
      const line = document.createElement("p");
      line.textContent = `Not taken by the server: ${each.participant}, ${each.step}. ${each.refused}`;
      return line;
    }),
    remove,
  );
}

async function begin() {
  if ("serviceWorker" in navigator) navigator.serviceWorker.register("/service-worker.js");
  await open(study, report);
  navigator.storage?.persist?.();
  await send();
  const current = localStorage.getItem(CURRENT);
  const found = current ? await one("interviews", current) : null;
  if (found) await take(found);
  else await leave("start");
}

begin().catch((error) => {
  problem.textContent = `This browser cannot keep interviews (${error.message}). Use another, and no private window.`;
  problem.hidden = false;
});
