"use strict";
// Counts the break down; the server decides when it is over.
const shown = document.querySelector("[data-seconds]");
const status = document.querySelector("main [role=status]");
const button = document.querySelector("main form button");
const over = Date.now() + 1000 * Number(shown.dataset.seconds);

function show() {
  const left = Math.max(0, Math.ceil((over - Date.now()) / 1000));
  shown.textContent = `${Math.floor(left / 60)}:${String(left % 60).padStart(2, "0")}`;
  button.disabled = left > 0;
  if (left > 0) setTimeout(show, 250);
  else status.textContent = "You can go on now.";
}
show();
