import { positionsOf } from "./geometry.mjs";
import { tetrahedronFacts } from "./readout.mjs";
import { setMarked, triangleAt } from "./scene.mjs";

/** Marks the tetrahedron whose face was clicked, and tells about it. */
export function pick(viewer, event) {
  if (!viewer.faces) return;
  const box = viewer.canvas.getBoundingClientRect();
  const x = (2 * (event.clientX - box.left)) / box.width - 1;
  const y = 1 - (2 * (event.clientY - box.top)) / box.height;
  const face = triangleAt(viewer.scene, x, y);
  unmark(viewer);
  if (face !== null) mark(viewer, viewer.faces.cell[face]);
}

function mark(viewer, cell) {
  const { mesh } = viewer.viewed;
  const [a, b, c, d] = mesh.cells.slice(4 * cell, 4 * cell + 4);
  setMarked(viewer.scene, positionsOf(mesh.points, [a, b, a, c, a, d, b, c, b, d, c, d]));
  viewer.picked.replaceChildren(...tetrahedronFacts(viewer.viewed, cell));
  viewer.picked.hidden = false;
  viewer.container.dataset.pickedTetrahedron = cell;
}

/** No tetrahedron is marked any more. */
export function unmark(viewer) {
  setMarked(viewer.scene, new Float32Array(0));
  viewer.picked.hidden = true;
  delete viewer.container.dataset.pickedTetrahedron;
}
