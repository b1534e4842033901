"use strict";
// Sends what is typed every few seconds, so that a closed browser loses nothing.
const area = document.querySelector("textarea[data-draft]");
const state = document.querySelector("[data-draft-state]");
const token = document.querySelector("meta[name=csrf-token]").content;
let kept = area.value;
let timer = null;

async function keep() {
  timer = null;
  const text = area.value;
  if (text === kept) return;
  try {
    const answer = await fetch(area.dataset.draft, {
      method: "POST",
      keepalive: true,
      headers: { "X-CSRF-Token": token },
      body: new URLSearchParams({ text, quiet: "1" }),
    });
    if (answer.status === 409) {
      kept = text;
      state.textContent = "This description was sent already and cannot be changed.";
      return;
    }
    if (!answer.ok) throw new Error(String(answer.status));
    kept = text;
    state.textContent = "Draft kept.";
  } catch {
    state.textContent = "The draft could not be kept; trying again.";
    timer ??= setTimeout(keep, 5000);
  }
}

area.addEventListener("input", () => {
  state.textContent = "";
  timer ??= setTimeout(keep, 2000);
});
addEventListener("pagehide", keep);
document.addEventListener("visibilitychange", () => {
  if (document.visibilityState === "hidden") keep();
});
area.form.addEventListener("submit", () => {
  clearTimeout(timer);
  kept = area.value;
});
