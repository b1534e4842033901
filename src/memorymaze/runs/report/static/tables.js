// Lists of episodes and leaderboards: sort by a click on a column's head, filter by words.
"use strict";

for (const table of document.querySelectorAll("table.sortable")) {
  makeSortable(table);
}
for (const tools of document.querySelectorAll("[data-filter]")) {
  const table = tools.nextElementSibling.querySelector("table");
  tools.hidden = false;
  tools.querySelector("input").addEventListener("input", (event) => {
    filter(table, event.target.value, tools.querySelector("[role=status]"));
  });
}

function makeSortable(table) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      for (const each of heads) each.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      sort(table, column, down ? -1 : 1);
    });
  });
}

function sort(table, column, direction) {
  const body = table.tBodies[0];
  const keyed = [...body.rows].map((row) => [key(row.cells[column]), row]);
  keyed.sort(([one], [other]) => direction * compare(one, other));
  body.append(...keyed.map(([, row]) => row));
}

function key(cell) {
  const text = (cell.dataset.value ?? cell.textContent).trim();
  const number = Number.parseFloat(text);
  const isNumber = cell.classList.contains("num") && !Number.isNaN(number);
  return isNumber ? number : text;
}

function compare(one, other) {
  if (typeof one === "number" && typeof other === "number") return one - other;
  if (typeof one !== typeof other) return typeof one === "number" ? -1 : 1;
  return one.localeCompare(other, "en", { numeric: true });
}

function filter(table, words, status) {
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const row of table.tBodies[0].rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !wanted.every((word) => text.includes(word));
    shown += row.hidden ? 0 : 1;
  }
  status.textContent = wanted.length ? `${shown} of ${table.tBodies[0].rows.length} shown` : "";
}
