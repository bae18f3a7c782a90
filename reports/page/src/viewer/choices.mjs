import { choose, chosen, control, countAt, POSITION_STEPS, setOutput, stepOf } from "./controls.mjs";
import { countText, numberText } from "./number_texts.mjs";
import { MEASURES } from "./palette.mjs";
import { towardsObserver } from "./scene.mjs";
import { extentOf, thresholdOf } from "./viewed_mesh.mjs";
import { countWorseThan } from "./worst_cells.mjs";

/** How many of the worst cells are shown at first. */
const FIRST_WORST_COUNT = 100;

const AXIS_NORMALS = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** Another mesh begins cut open through its middle, across y. */
export function resetChoices(viewer) {
  choose(viewer.form, "cut-axis", "y");
  takeCutAxis(viewer);
  setWorstCount(viewer, Math.min(FIRST_WORST_COUNT, viewer.viewed.mesh.regions.length));
}

/** Takes over a new axis of the cut: the side toward the observer goes, as far as the middle. */
export function takeCutAxis(viewer) {
  const { form } = viewer;
  const axis = chosen(form, "cut-axis");
  const toward = towardsObserver(viewer.scene);
  viewer.cutNormal = axis === "none" ? null : axis === "view" ? toward : AXIS_NORMALS[axis];
  for (const name of ["cut-position", "cut-flip"]) control(form, name).disabled = axis === "none";
  if (!viewer.cutNormal) return;
  const along = viewer.cutNormal.reduce((sum, component, i) => sum + component * toward[i], 0);
  control(form, "cut-flip").checked = along < 0;
  control(form, "cut-position").value = POSITION_STEPS / 2;
}

/** The plane of the cut as the controls say; its place is written beside the slider. */
export function takePlane({ form, viewed, cutNormal }) {
  if (!cutNormal) {
    setOutput(form, "cut-position", "");
    return null;
  }
  const { low, high } = extentOf(viewed, cutNormal);
  const offset = low + ((high - low) * control(form, "cut-position").value) / POSITION_STEPS;
  setOutput(form, "cut-position", numberText(offset));
  return control(form, "cut-flip").checked ? { normal: cutNormal.map((x) => -x), offset: -offset } : { normal: cutNormal, offset };
}

/** Shows this many of the worst cells; the controls show that number, and the threshold that all of them exceed. */
export function setWorstCount(viewer, count) {
  const { form, viewed } = viewer;
  const measure = control(form, "worst").value;
  const isAll = measure === "none";
  viewer.worstCount = count;
  control(form, "worst-count").value = stepOf(count, viewed.mesh.regions.length);
  for (const name of ["worst-count", "worst-threshold"]) control(form, name).disabled = isAll;
  const threshold = isAll ? null : thresholdOf(viewed, measure, count);
  control(form, "worst-threshold").value = threshold === null ? "" : Number(threshold.toPrecision(4));
  setOutput(form, "worst-count", isAll ? "" : countText(count));
}

/** The slider of the count has moved. */
export function takeWorstCount(viewer) {
  setWorstCount(viewer, countAt(Number(control(viewer.form, "worst-count").value), viewer.viewed.mesh.regions.length));
}

/** A threshold has been entered: the cells that are worse are shown. */
export function takeThreshold(viewer) {
  const field = control(viewer.form, "worst-threshold");
  const measure = control(viewer.form, "worst").value;
  const threshold = field.valueAsNumber;
  if (measure === "none" || Number.isNaN(threshold)) return;
  const { values, worst } = viewer.viewed;
  setWorstCount(viewer, countWorseThan(values[measure], worst[measure](), threshold, MEASURES[measure].largestIsWorst));
  field.value = threshold;
}
