import { commandLine } from "../page/copy.mjs";
import { element } from "../page/dom.mjs";
import { openTrace, traceButton } from "../page/trace.mjs";
import { createAxesMark } from "./axes_mark.mjs";
import { resetChoices, setWorstCount, takeCutAxis, takeThreshold, takeWorstCount } from "./choices.mjs";
import { control, createControls } from "./controls.mjs";
import { askDraw, askUpdate, resize, update } from "./drawing.mjs";
import { navigate } from "./navigation.mjs";
import { pick } from "./picking.mjs";
import * as scene from "./scene.mjs";
import { viewedMesh } from "./viewed_mesh.mjs";

/**
 * Puts a viewer of the kept meshes into a container: turned by mouse, touch and keys, cut by a plane, colored by
 * quality, reduced to the worst tetrahedra. It draws only when something has changed.
 *
 * For tests, the container tells by its data: `viewerMesh` (the file that is drawn, absent until then),
 * `shownTetrahedra`, `shownFaces`, `cameraPosition`, `color`, `pickedTetrahedron`.
 *
 * @param {HTMLElement} container
 * @param {Object<string, object>} keptMeshes  JSON of schema `ccdt.mesh/1`, by file
 * @param {{meshes: {file: string, title: string, run: string}[], runs: Object<string, {command: string}>}} report
 */
export function mountViewer(container, keptMeshes, { meshes, runs }) {
  container.classList.add("viewer");
  container.dataset.viewer = "";
  const available = meshes.filter(({ file }) => keptMeshes[file]);
  const absence = available.length === 0 ? "This report has no meshes."
    : hasWebGl() ? "" : "Meshes are drawn with WebGL, which this browser does not offer.";
  if (absence) {
    container.append(element("p.viewer-absent", {}, absence));
    return;
  }
  const viewer = assemble(container, available);
  const open = () => openMesh(viewer, keptMeshes, available[control(viewer.form, "mesh").value], runs);
  viewer.navigation = navigate(viewer.canvas, viewer.scene.camera, {
    changed: () => askDraw(viewer),
    clicked: (event) => {
      pick(viewer, event);
      askDraw(viewer);
    },
  });
  listenToControls(viewer, open);
  listenToPage(viewer);
  open();
}

function hasWebGl() {
  const context = document.createElement("canvas").getContext("webgl2");
  // Browsers grant few of them.
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}

function assemble(container, available) {
  const canvas = element("canvas", { tabindex: 0, role: "img", "aria-label": "The mesh; arrow keys turn it" });
  const viewer = {
    container,
    canvas,
    stage: element("div.viewer-stage", {}, canvas),
    form: createControls(available.map(({ title }) => title)),
    readout: element("div.viewer-readout", { "data-readout": "" }),
    hint: element("p.viewer-hint", {},
      "Drag to turn, scroll or pinch to zoom, drag with the right button or two fingers to shift; or arrow keys, +, − " +
      "and Home. Click a face for the numbers of its tetrahedron."),
    source: element("div.viewer-source"),
    axes: createAxesMark(),
    legend: element("div.viewer-legend"),
    picked: element("div.viewer-picked", { "data-picked": "", "aria-live": "polite", hidden: true }),
    scene: scene.createScene(canvas),
  };
  viewer.stage.append(viewer.axes, viewer.legend, viewer.picked);
  container.append(viewer.stage, viewer.form, viewer.readout, viewer.hint, viewer.source);
  return viewer;
}

function listenToControls(viewer, open) {
  const { form, navigation } = viewer;
  const on = (name, type, action) =>
    form.querySelectorAll(`[data-control="${name}"]`).forEach((node) => node.addEventListener(type, action));
  const thenUpdate = (action) => () => {
    if (!viewer.viewed) return;
    action();
    askUpdate(viewer);
  };
  on("mesh", "change", open);
  // A click on "as seen" counts each time, as the observer may have moved.
  on("cut-axis", "click", thenUpdate(() => takeCutAxis(viewer)));
  on("worst", "change", thenUpdate(() => setWorstCount(viewer, viewer.worstCount)));
  on("worst-count", "input", thenUpdate(() => takeWorstCount(viewer)));
  on("worst-threshold", "change", thenUpdate(() => takeThreshold(viewer)));
  for (const name of ["cut-position", "cut-flip", "color", "edges"]) on(name, "input", () => askUpdate(viewer));
  on("zoom-in", "click", navigation.zoomIn);
  on("zoom-out", "click", navigation.zoomOut);
  on("reset", "click", navigation.reset);
}

function listenToPage(viewer) {
  new ResizeObserver(() => resize(viewer)).observe(viewer.stage);
  const takeTheme = () => {
    const style = getComputedStyle(viewer.container);
    const color = (name) => style.getPropertyValue(`--viewer-${name}`).trim();
    scene.setLineColors(viewer.scene, { edge: color("edge"), outline: color("outline"), marked: color("marked") });
    askDraw(viewer);
  };
  document.addEventListener("themechange", takeTheme);
  takeTheme();
}

async function openMesh(viewer, keptMeshes, { file, title, run }, runs) {
  delete viewer.container.dataset.viewerMesh;
  viewer.opening = file;
  let viewed;
  try {
    viewed = await viewedMesh(keptMeshes[file]);
  } catch (error) {
    viewer.readout.replaceChildren(`${file} cannot be shown: ${error.message}`);
    return;
  }
  // Another one may have been chosen by now.
  if (viewer.opening !== file) return;
  viewer.viewed = viewed;
  scene.lookAt(viewer.scene, viewed.sphere);
  viewer.navigation.startFrom(viewed.sphere.center);
  resize(viewer);
  resetChoices(viewer);
  update(viewer);
  const traceRun = traceButton([run], title, () => openTrace({ runs }, title, [], [run]));
  viewer.source.replaceChildren(element("span.quiet", {}, `${file}, made by this command:`), traceRun,
    commandLine(runs[run]?.command ?? "not in this report"));
  viewer.container.dataset.viewerMesh = file;
}
