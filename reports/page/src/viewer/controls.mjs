import { element } from "../page/dom.mjs";

/** Steps of the sliders: of the cut's position, and of the logarithm of a count. */
export const POSITION_STEPS = 400;
export const COUNT_STEPS = 300;

const AXES = [["none", "none"], ["x", "x"], ["y", "y"], ["z", "z"], ["view", "as seen"]];
const COLORINGS = [["plain", "surface, inside"], ["r", "measure r"], ["dihedral", "dihedral angle"]];
const PARTS = [["none", "all"], ["r", "the worst by r"], ["dihedral", "the worst by angle"]];

/**
 * The form beside the picture. Each control has a `data-control`, by which it is found.
 * @param {string[]} titles  of the meshes
 * @returns {HTMLFormElement}
 */
export function createControls(titles) {
  return element("form.viewer-controls", { onsubmit: (event) => event.preventDefault() },
    labeled("Mesh", select("mesh", titles.map((title, i) => [i, title]))),
    group("Cut across",
      element("span.viewer-choices", {}, AXES.map(([value, text]) => radio("cut-axis", value, text))),
      labeled("Position", slider("cut-position", POSITION_STEPS), output("cut-position")),
      checkbox("cut-flip", "show the other side")),
    group("Show",
      labeled("Tetrahedra", select("worst", PARTS)),
      labeled("How many", slider("worst-count", COUNT_STEPS), output("worst-count")),
      labeled("Worse than", element("input", { type: "number", step: "any", "data-control": "worst-threshold" }))),
    group("Color", labeled("By", select("color", COLORINGS)), checkbox("edges", "edges", true)),
    element("span.viewer-buttons", {},
      button("zoom-in", "Zoom in"), button("zoom-out", "Zoom out"), button("reset", "Reset view")));
}

/** The control of a name. */
export const control = (form, name) => form.querySelector(`[data-control="${name}"]`);

/** The chosen one of the radio buttons of a name. */
export const chosen = (form, name) => form.querySelector(`[data-control="${name}"]:checked`).value;

/** Chooses one of the radio buttons of a name. */
export const choose = (form, name, value) => {
  form.querySelector(`[data-control="${name}"][value="${value}"]`).checked = true;
};

/** Writes beside a slider what it stands for. */
export const setOutput = (form, name, text) => {
  form.querySelector(`[data-output="${name}"]`).textContent = text;
};

/** The count that a slider's place stands for, from 1 to all, evenly by logarithm. */
export const countAt = (step, all) => Math.round(Math.max(1, all) ** (step / COUNT_STEPS));

/** The place of a count on the slider. */
export const stepOf = (count, all) => (all > 1 ? Math.round((COUNT_STEPS * Math.log(Math.max(1, count))) / Math.log(all)) : COUNT_STEPS);

const group = (title, ...children) => element("fieldset", {}, element("legend", {}, title), children);
const labeled = (text, ...children) => element("label", {}, element("span", {}, text), children);
const slider = (name, steps) => element("input", { type: "range", min: 0, max: steps, step: 1, "data-control": name });
const output = (name) => element("output", { "data-output": name });
const button = (name, text) => element("button.small", { type: "button", "data-control": name }, text);

function select(name, choices) {
  return element("select", { "data-control": name }, choices.map(([value, text]) => element("option", { value }, text)));
}

function radio(name, value, text) {
  return element("label.viewer-choice", {}, element("input", { type: "radio", name, value, "data-control": name }), text);
}

function checkbox(name, text, checked = false) {
  return element("label.viewer-choice", {}, element("input", { type: "checkbox", checked, "data-control": name }), text);
}
