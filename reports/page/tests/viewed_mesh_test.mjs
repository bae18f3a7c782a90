import assert from "node:assert/strict";
import test from "node:test";

import { COUNT_STEPS, countAt, stepOf } from "../src/viewer/controls.mjs";
import { edgesOf, positionsOf, sphereAround } from "../src/viewer/geometry.mjs";
import { measureText, numberText } from "../src/viewer/number_texts.mjs";
import { MEASURES } from "../src/viewer/palette.mjs";
import { sharpEdges } from "../src/viewer/sharp_edges.mjs";
import { shownPart, thresholdOf, viewedMesh, worstValue } from "../src/viewer/viewed_mesh.mjs";
import { block, kept, meshOf, regularTetrahedron } from "./small_meshes.mjs";

const everything = { plane: null, worst: "none", count: 1 };
const ordered = (edges) => {
  const pairs = [];
  for (let i = 0; i < edges.length; i += 2) pairs.push([...edges.slice(i, i + 2)].sort((a, b) => a - b).join());
  return pairs.sort();
};

test("each edge of a tetrahedron's surface is drawn once", async () => {
  const { surface } = await viewedMesh(kept(regularTetrahedron));
  assert.deepEqual(ordered(edgesOf(surface.corners)), ["0,1", "0,2", "0,3", "1,2", "1,3", "2,3"]);
});

test("the sharp edges of a block are those of its twelve sides", async () => {
  const { mesh, surface } = await viewedMesh(kept(block(3, 2, 1)));
  assert.equal(edgesOf(surface.corners).length / 2, (3 * 2 * 2 * (3 * 2 + 2 * 1 + 1 * 3)) / 2);
  assert.equal(sharpEdges(mesh.points, surface.corners).length / 2, 4 * (3 + 2 + 1));
});

test("positions are those of the vertices, in their order", () => {
  assert.deepEqual([...positionsOf(new Float32Array([1, 2, 3, 4, 5, 6]), [1, 0])], [4, 5, 6, 1, 2, 3]);
});

test("the sphere around a block is the one around its corners", () => {
  const { center, radius } = sphereAround(block(4, 2, 4).points);
  assert.deepEqual(center, [2, 1, 2]);
  assert.equal(radius, 3);
});

test("without a cut and a count all tetrahedra are shown", async () => {
  const viewed = await viewedMesh(kept(block(2, 2, 2)));
  const { faces, count } = shownPart(viewed, everything);
  assert.equal(count, 48);
  assert.equal(faces.cell.length, 48);
});

test("of the worst tetrahedra, only those that the cut leaves are shown", async () => {
  const good = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const flat = (x, height) => [[x, 0, 0], [x + 1, 0, 0], [x, 1, 0], [x, 0, height]];
  const mesh = meshOf([...good, ...flat(10, 0.1), ...flat(20, 0.2)], [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9, 10, 11]]);
  const viewed = await viewedMesh(kept(mesh));
  for (const worst of ["r", "dihedral"]) {
    assert.deepEqual(new Set(shownPart(viewed, { plane: null, worst, count: 2 }).faces.cell), new Set([1, 2]));
    const plane = { normal: [1, 0, 0], offset: 15 };
    assert.deepEqual(new Set(shownPart(viewed, { plane, worst, count: 2 }).faces.cell), new Set([1]));
    assert.equal(thresholdOf(viewed, worst, 2), viewed.values[worst][2]);
    assert.equal(worstValue(viewed, worst), viewed.values[worst][1]);
  }
});

test("a mesh without tetrahedra has no worst ones", async () => {
  const viewed = await viewedMesh(kept(meshOf([], [])));
  assert.equal(shownPart(viewed, everything).count, 0);
  assert.equal(thresholdOf(viewed, "r", 1), null);
  assert.equal(worstValue(viewed, "dihedral"), null);
});

test("the slider of the count goes from one tetrahedron to all, evenly by logarithm", () => {
  assert.equal(countAt(0, 5000), 1);
  assert.equal(countAt(COUNT_STEPS, 5000), 5000);
  assert.equal(countAt(COUNT_STEPS / 2, 10000), 100);
  assert.equal(stepOf(100, 10000), COUNT_STEPS / 2);
  assert.equal(stepOf(1, 1), COUNT_STEPS);
  assert.equal(countAt(0, 0), 1);
});

test("numbers have three significant digits; missing and infinite ones are words", () => {
  assert.equal(numberText(1.23456), "1.23");
  assert.equal(numberText(-123456), "-1.23e+5");
  assert.equal(numberText(0), "0");
  assert.equal(numberText(Infinity), "infinite");
  assert.equal(measureText(MEASURES.dihedral, 24.183), "24.2°");
  assert.equal(measureText(MEASURES.dihedral, null), "none");
});
