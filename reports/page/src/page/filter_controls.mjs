import { element } from "./dom.mjs";
import { choicesOf, isFiltering, openFilters, rangesOf } from "./filters.mjs";
import { numberText } from "./numbers.mjs";

function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function isNumber(text) {
  return text !== "" && Number.isFinite(Number(text));
}

/** A panel that would reach over the right edge of the page opens to the left. */
function keepInside(panel) {
  panel.classList.remove("leftward");
  const isOver = panel.getBoundingClientRect().right > document.documentElement.clientWidth;
  panel.classList.toggle("leftward", isOver);
}

/** A check box for each value of a label. */
function choiceControl(section, choice, state, changed) {
  const excluded = new Set();
  const summary = element("span.chosen", {});
  const boxes = choice.values.map((value) => {
    const box = element("input", { type: "checkbox", value, checked: true });
    box.addEventListener("change", () => apply());
    return box;
  });
  const tick = (wanted) => {
    for (const box of boxes) box.checked = wanted(box);
    apply();
  };
  const options = boxes.map((box) =>
    element(
      "div.option",
      {},
      element("label", {}, box, isNumber(box.value) ? numberText(Number(box.value)) : box.value),
      element(
        "button.small.only",
        { type: "button", "aria-label": `Only ${box.value}`, onclick: () => tick((one) => one === box) },
        "only",
      ),
    ),
  );
  const control = element(
    "details.filter",
    { "data-filter": `${section.name}/${choice.name}` },
    element("summary", {}, `${capital(choice.title)}: `, summary),
    element(
      "div.panel",
      {},
      options,
      element("p.actions", {}, element("button.small", { type: "button", onclick: () => tick(() => true) }, "All")),
    ),
  );

  control.addEventListener("toggle", () => keepInside(control.querySelector(".panel")));

  function describe() {
    const ticked = boxes.filter((box) => box.checked);
    summary.textContent =
      excluded.size === 0 ? "all" : ticked.length === 1 ? ticked[0].value : `${ticked.length} of ${boxes.length}`;
    control.classList.toggle("active", excluded.size > 0);
  }
  function apply() {
    excluded.clear();
    for (const box of boxes) if (!box.checked) excluded.add(box.value);
    if (excluded.size > 0) state.without.set(choice.name, excluded);
    else state.without.delete(choice.name);
    describe();
    changed();
  }
  describe();
  return { control, reset: () => tick(() => true) };
}

function boundSelect(bounds, chosen, label, change) {
  const select = element(
    "select",
    { "aria-label": label, onchange: change },
    bounds.map((bound) => element("option", { value: bound, selected: bound === chosen }, numberText(bound))),
  );
  return select;
}

/** The smallest and the largest size that are shown. */
function rangeControl(section, range, state, changed) {
  const { bounds } = range;
  const from = boundSelect(bounds, bounds[0], `${range.title} from`, () => apply());
  const to = boundSelect(bounds, bounds.at(-1), `${range.title} to`, () => apply());
  const control = element(
    "div.filter.range",
    { "data-filter": `${section.name}/${range.name}` },
    `${capital(range.title)}: `,
    from,
    " to ",
    to,
  );
  function apply() {
    const low = Number(from.value),
      high = Number(to.value);
    const isOpen = low === bounds[0] && high === bounds.at(-1);
    if (isOpen) state.ranges.delete(range.name);
    else state.ranges.set(range.name, { low, high });
    control.classList.toggle("active", !isOpen);
    changed();
  }
  const reset = () => {
    from.value = bounds[0];
    to.value = bounds.at(-1);
    apply();
  };
  return { control, reset };
}

function closeOthers(bar) {
  document.addEventListener("click", (event) => {
    for (const open of bar.querySelectorAll("details[open]")) if (!open.contains(event.target)) open.open = false;
  });
  bar.addEventListener("keydown", (event) => {
    const open = event.target.closest("details[open]");
    if (event.key !== "Escape" || !open) return;
    open.open = false;
    open.querySelector("summary").focus();
  });
}

/**
 * The controls that filter a section.
 * @param {object} section
 * @param {(state: import("./filters.mjs").FilterState) => void} show  called when something has changed
 * @returns {Element|null}  null: there is nothing to choose
 */
export function filterControls(section, show) {
  const state = openFilters();
  const reset = element("button.small", { type: "button", hidden: true }, "Show everything");
  const changed = () => {
    reset.hidden = !isFiltering(state);
    show(state);
  };
  const controls = [
    ...choicesOf(section).map((choice) => choiceControl(section, choice, state, changed)),
    ...rangesOf(section).map((range) => rangeControl(section, range, state, changed)),
  ];
  if (controls.length === 0) return null;
  reset.addEventListener("click", () => {
    for (const control of controls) control.reset();
  });
  const bar = element(
    "div.filters",
    { role: "group", "aria-label": `Filters of ${section.title}` },
    controls.map(({ control }) => control),
    reset,
  );
  closeOthers(bar);
  return bar;
}
