// Marks on a plan: places are pressed instead of typed, and a way of one's own is drawn.

export function prepare(form) {
  const places = [...form.querySelectorAll(".place")];
  const way = form.elements.places;
  const failures = form.querySelector(".failures");
  const another = form.querySelector(".another");
  let field = way;

  const numbers = () => way.value.split(/[\s,]+/).filter(Boolean);

  function show() {
    const told = numbers();
    const known = told.map((n) => places.find((each) => each.dataset.number === n));
    const wrong = told.filter((_, at) => !known[at]);
    way.setCustomValidity(
      wrong.length ? `There is no place ${wrong.join(", ")} on the plan.` : "",
    );
    form.querySelector(".drawn").setAttribute(
      "points",
      known.filter(Boolean).map((each) => `${each.dataset.x},${each.dataset.y}`).join(" "),
    );
    const chosen = new Set([...form.querySelectorAll("select")].map((each) => each.value));
    for (const place of places) {
      place.classList.toggle(
        "chosen",
        chosen.has(place.dataset.place) || told.includes(place.dataset.number),
      );
    }
    for (const row of form.querySelectorAll(".failure")) {
      const [kind, where] = row.querySelectorAll("select");
      const detail = row.querySelector("input");
      where.required = Boolean(kind.value);
      kind.required = Boolean(where.value || detail.value);
    }
  }

  function press(place) {
    if (field === way) {
      way.value = [...numbers(), place.dataset.number].join(" ");
      form.querySelector("input[name=way][value=none]").checked = true;
    } else {
      field.value = place.dataset.place;
    }
    show();
  }

  function go(place, step) {
    const next = places[(places.indexOf(place) + step + places.length) % places.length];
    for (const each of places) each.setAttribute("tabindex", each === next ? "0" : "-1");
    next.focus();
  }

  for (const place of places) {
    place.addEventListener("click", () => press(place));
    place.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (step) go(place, step);
      else if (event.key === "Enter" || event.key === " ") press(place);
      else return;
      event.preventDefault();
    });
  }
  form.addEventListener("focusin", (event) => {
    if (event.target === way) field = way;
    const row = event.target.closest(".failure");
    if (row) field = row.querySelector("select[name^=where]");
  });
  form.addEventListener("input", show);

  function addRow() {
    const rows = failures.querySelectorAll(".failure");
    const row = rows[0].cloneNode(true);
    const number = rows.length;
    row.setAttribute("aria-label", `Error ${number + 1}`);
    row.querySelector("span").textContent = `Error ${number + 1}`;
    for (const each of row.querySelectorAll("select, input")) {
      each.name = each.name.replace(/\d+$/, String(number));
      if (each.tagName === "SELECT") each.selectedIndex = 0;
      else each.value = "";
    }
    another.before(row);
    another.hidden = number + 1 >= Number(failures.dataset.most);
    return row;
  }
  another.hidden = false;
  another.addEventListener("click", () => addRow().querySelector("select").focus());
  show();
  return { show, addRow };
}

for (const form of document.querySelectorAll("form[data-marks]:not([data-later])")) {
  prepare(form);
}
