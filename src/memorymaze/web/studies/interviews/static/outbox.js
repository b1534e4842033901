// What lies on the tablet: open interviews, recordings, and what is still to be sent.
// Everything is on its disk before the page goes on; it is removed when the server has it.

const STORES = {
  interviews: { keyPath: "id" },
  records: { keyPath: "order", autoIncrement: true },
  takes: { keyPath: "id" },
  chunks: { autoIncrement: true },
};
const REFUSED = [400, 404, 409, 410, 413];
const LATER = 15000;
let base = null;
let tell = () => {};

export function open(study, report) {
  tell = report;
  return new Promise((resolve, reject) => {
    const asked = indexedDB.open(`interviews of ${study}`, 1);
    asked.onupgradeneeded = () => {
      for (const [name, options] of Object.entries(STORES)) {
        const made = asked.result.createObjectStore(name, options);
        if (name === "chunks") made.createIndex("take", "take");
      }
    };
    asked.onerror = () => reject(asked.error);
    asked.onsuccess = () => {
      base = asked.result;
      addEventListener("online", send);
      setInterval(send, LATER);
      resolve();
    };
  });
}

export function newId(bytes) {
  const some = crypto.getRandomValues(new Uint8Array(bytes));
  return [...some].map((each) => each.toString(16).padStart(2, "0")).join("");
}

// Runs `work` with the stores as one step; it is on the disk when this resolves.
export function change(work) {
  return new Promise((resolve, reject) => {
    const step = base.transaction(Object.keys(STORES), "readwrite", { durability: "strict" });
    step.oncomplete = resolve;
    step.onerror = step.onabort = () => reject(step.error);
    work(Object.fromEntries(Object.keys(STORES).map((name) => [name, step.objectStore(name)])));
  });
}

function read(store, ask) {
  return new Promise((resolve, reject) => {
    const asked = ask(base.transaction(store).objectStore(store));
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error);
  });
}

export const all = (store) => read(store, (each) => each.getAll());
export const one = (store, key) => read(store, (each) => each.get(key));
export const chunksOf = (take) => read("chunks", (each) => each.index("take").getAll(take));

export function forgetTake({ takes, chunks }, take) {
  takes.delete(take);
  chunks.index("take").openKeyCursor(IDBKeyRange.only(take)).onsuccess = (event) => {
    const found = event.target.result;
    if (!found) return;
    chunks.delete(found.primaryKey);
    found.continue();
  };
}

let sending = null;
let isNew = false;

export function send() {
  isNew = true;
  sending ??= sendWhatComes().finally(() => {
    sending = null;
  });
  return sending;
}

// What is answered while others are sent goes with them.
async function sendWhatComes() {
  while (isNew) {
    isNew = false;
    await sendAll();
  }
}

async function sendAll() {
  let why = "";
  try {
    const waiting = (await all("records")).filter((each) => !each.refused);
    const token = waiting.length ? await freshToken() : "";
    for (const record of waiting) {
      await report("Sending.");
      await sendOne(record, token);
    }
  } catch (error) {
    why = error instanceof TypeError ? "The server cannot be reached now." : error.message;
  }
  await report(why);
}

// The page may be older than the server: what protects forms is asked for anew.
async function freshToken() {
  const answer = await fetch("/offline", { cache: "no-store" });
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  return page.querySelector("meta[name=csrf-token]").content;
}

async function sendOne(record, token) {
  const about = { step: record.step, opened: record.opened, at: record.at };
  const place = `/interviews/${record.participant}`;
  const headers = { "X-CSRF-Token": token };
  const answer = record.blob
    ? await fetch(
        `${place}/recordings/${record.id}?${new URLSearchParams({ ...about, seconds: record.seconds })}`,
        { method: "POST", headers, body: record.blob },
      )
    : await fetch(`${place}/records/${record.id}`, {
        method: "POST",
        headers,
        body: new URLSearchParams({ ...record.fields, ...about }),
      });
  if (answer.ok) {
    await change(({ records }) => records.delete(record.order));
  } else if (REFUSED.includes(answer.status)) {
    const said = await answer.json().catch(() => ({}));
    record.refused = said.refused || `code ${answer.status}`;
    await change(({ records }) => records.put(record));
  } else if (answer.status === 403) {
    throw new Error(
      "The server does not know this tablet: open the experimenter's address that it printed.",
    );
  } else {
    throw new Error(`The server answered with code ${answer.status}; it is tried again.`);
  }
}

async function report(why) {
  const records = await all("records");
  tell(
    records.filter((each) => !each.refused),
    records.filter((each) => each.refused),
    why,
  );
}
