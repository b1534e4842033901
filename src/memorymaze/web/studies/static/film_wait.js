"use strict";
// Asks how far the video is, and goes on when it is there.
const shown = document.querySelector("[data-film]");

async function look() {
  try {
    const answer = await fetch(shown.dataset.film);
    if (answer.ok) {
      const state = await answer.json();
      if (state.ready) return location.reload();
      const left = state.left ? `Time left: ${state.left}` : "";
      if (shown.textContent !== left) shown.textContent = left;
    }
  } catch {
    // The server may be back in a moment.
  }
  setTimeout(look, 2000);
}
setTimeout(look, 2000);
