import { turnAxesMark } from "./axes_mark.mjs";
import { takePlane } from "./choices.mjs";
import { control } from "./controls.mjs";
import { edgesOf, positionsOf } from "./geometry.mjs";
import { legendOf } from "./legend.mjs";
import { colorOf, MEASURES } from "./palette.mjs";
import { unmark } from "./picking.mjs";
import { readoutOf } from "./readout.mjs";
import * as scene from "./scene.mjs";
import { shownPart } from "./viewed_mesh.mjs";

const NOTHING = new Uint32Array(0);

/** Builds and draws what the controls ask for, once before the next frame, however often it is called. */
export function askUpdate(viewer) {
  if (viewer.updateAsked || !viewer.viewed) return;
  viewer.updateAsked = true;
  requestAnimationFrame(() => update(viewer));
}

/** Draws what is there, once before the next frame, however often it is called. */
export function askDraw(viewer) {
  if (viewer.drawAsked) return;
  viewer.drawAsked = true;
  requestAnimationFrame(() => draw(viewer));
}

/** Builds what the controls ask for, and draws it. */
export function update(viewer) {
  viewer.updateAsked = false;
  const { viewed, form, container } = viewer;
  const worst = control(form, "worst").value;
  const coloring = control(form, "color").value;
  const { faces, count } = shownPart(viewed, { plane: takePlane(viewer), worst, count: viewer.worstCount });
  viewer.faces = faces;
  buildScene(viewer, { faces, worst, coloring });
  unmark(viewer);
  viewer.legend.replaceChildren(...legendOf(coloring, viewed.colors));
  viewer.readout.replaceChildren(readoutOf(viewed, count));
  Object.assign(container.dataset, { shownTetrahedra: count, shownFaces: faces.cell.length, color: coloring });
  draw(viewer);
}

function buildScene(viewer, { faces, worst, coloring }) {
  const { viewed, form } = viewer;
  const at = (vertices) => positionsOf(viewed.mesh.points, vertices);
  const edges = control(form, "edges").checked ? edgesOf(faces.corners) : NOTHING;
  scene.setTriangles(viewer.scene, at(faces.corners), faceColors(viewed, faces, coloring), at(edges));
  if (worst === "none") scene.setOutline(viewer.scene, at(NOTHING), at(NOTHING));
  else scene.setOutline(viewer.scene, at(viewed.surface.corners), at(viewed.outline()));
}

function faceColors({ mesh, values, colors }, faces, coloring) {
  const ofCell = coloring === "plain"
    ? (cell, face) => colors.get(mesh.regions[cell])[faces.cut[face] ? "cut" : "surface"]
    : (cell) => colorOf(MEASURES[coloring], values[coloring][cell]);
  return Array.from(faces.cell, ofCell);
}

/** Fits the picture to its place in the page. */
export function resize(viewer) {
  const { clientWidth, clientHeight } = viewer.stage;
  if (!viewer.viewed || clientWidth === 0 || clientHeight === 0) return;
  scene.fit(viewer.scene, clientWidth, clientHeight, viewer.viewed.sphere.radius);
  // At once: changing the size has erased the picture.
  if (viewer.faces) draw(viewer);
}

function draw(viewer) {
  viewer.drawAsked = false;
  if (!viewer.viewed) return;
  const { camera } = viewer.scene;
  scene.draw(viewer.scene);
  turnAxesMark(viewer.axes, camera);
  viewer.container.dataset.cameraPosition = [...camera.position.toArray(), camera.zoom].map((x) => x.toPrecision(5)).join(" ");
}
