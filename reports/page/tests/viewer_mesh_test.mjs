import assert from "node:assert/strict";
import test from "node:test";

import { boundaryOf, neighborsOf } from "../src/viewer/boundary.mjs";
import { allCells, centroidsOf, cutAway, extentAlong } from "../src/viewer/cut.mjs";
import { unpackMesh } from "../src/viewer/kept_mesh.mjs";
import { cornersOf, dihedralAngles, measureR, qualityOfCells } from "../src/viewer/tetrahedron_quality.mjs";
import { countWorseThan, keepOnly, worstFirst } from "../src/viewer/worst_cells.mjs";
import { block, kept, meshOf, regularTetrahedron, twoTetrahedra } from "./small_meshes.mjs";

const near = (value, expected, tolerance = 1e-4) =>
  assert.ok(Math.abs(value - expected) <= tolerance, `${value} is not ${expected}`);

const neighbors = (mesh) => neighborsOf(mesh.cells, mesh.points.length / 3);

// A sixth of the sum over the faces, which is the volume inside if they are closed and look outward.
function volumeInside({ points }, { corners }) {
  let sum = 0;
  for (let face = 0; face < corners.length; face += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => points.subarray(3 * corners[face + i], 3 * corners[face + i] + 3));
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

test("a mesh is the same after packing and unpacking", async () => {
  const mesh = block(2, 1, 1);
  assert.deepEqual(await unpackMesh(kept(mesh)), mesh);
  assert.deepEqual(await unpackMesh(kept(twoTetrahedra)), twoTetrahedra);
});

test("a mesh without tetrahedra can be unpacked", async () => {
  assert.equal((await unpackMesh(kept(meshOf([], [])))).cells.length, 0);
});

test("a mesh whose arrays disagree is refused", async () => {
  await assert.rejects(unpackMesh({ ...kept(twoTetrahedra), tetrahedra: 3 }));
  await assert.rejects(unpackMesh({ ...kept(twoTetrahedra), vertices: 6 }));
  await assert.rejects(unpackMesh(kept(meshOf([[0, 0, 0]], [[0, 1, 2, 3]]))));
});

test("the regular tetrahedron has r = 1 and dihedral angles of 70.53 degrees", () => {
  const corners = cornersOf(regularTetrahedron, 0);
  near(measureR(corners), 1);
  assert.equal(dihedralAngles(corners).length, 6);
  dihedralAngles(corners).forEach((angle) => near(angle, 70.5288));
});

test("the corner of a cube has three right angles and three of 54.74 degrees", () => {
  const corners = cornersOf(twoTetrahedra, 0);
  const angles = dihedralAngles(corners).sort((a, b) => a - b);
  angles.slice(0, 3).forEach((angle) => near(angle, 54.7356));
  angles.slice(3).forEach((angle) => near(angle, 90));
  near(measureR(corners), (9 / 6) ** 1.5 / (8.48528 / 6));
});

test("a flat tetrahedron has infinite r and no smallest dihedral angle", () => {
  const mesh = meshOf([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]);
  const { r, smallestDihedral } = qualityOfCells(mesh);
  assert.equal(r[0], Infinity);
  assert.equal(smallestDihedral[0], 0);
});

test("two tetrahedra have six faces outside, and one alone has four, of which one is cut", () => {
  const both = boundaryOf(twoTetrahedra.cells, neighbors(twoTetrahedra), new Uint8Array([1, 1]));
  assert.equal(both.cell.length, 6);
  assert.equal(both.cut.indexOf(1), -1);
  near(volumeInside(twoTetrahedra, both), 1 / 2);

  const second = boundaryOf(twoTetrahedra.cells, neighbors(twoTetrahedra), new Uint8Array([0, 1]));
  assert.deepEqual([...second.cell], [1, 1, 1, 1]);
  assert.equal(second.cut.reduce((sum, cut) => sum + cut), 1);
  const cutFace = second.cut.indexOf(1);
  assert.deepEqual([...second.corners.slice(3 * cutFace, 3 * cutFace + 3)].sort(), [1, 2, 3]);
  near(volumeInside(twoTetrahedra, second), 1 / 3);
});

test("the boundary of a block encloses its volume", () => {
  const mesh = block(4, 3, 2);
  const faces = boundaryOf(mesh.cells, neighbors(mesh), allCells(mesh.regions.length));
  assert.equal(faces.cell.length, 2 * 2 * (4 * 3 + 3 * 2 + 2 * 4));
  near(volumeInside(mesh, faces), 24);
});

test("neighbors are mutual, and share three vertices", () => {
  const mesh = block(3, 2, 2);
  const across = neighbors(mesh);
  across.forEach((neighbor, face) => {
    if (neighbor < 0) return;
    const cell = face >> 2;
    assert.ok(across.slice(4 * neighbor, 4 * neighbor + 4).includes(cell));
    const other = new Set(mesh.cells.slice(4 * neighbor, 4 * neighbor + 4));
    assert.equal(mesh.cells.slice(4 * cell, 4 * cell + 4).filter((vertex) => other.has(vertex)).length, 3);
    assert.ok(!other.has(mesh.cells[face]), "the face is opposite the corner of its place");
  });
});

test("a plane takes whole tetrahedra away, by their centroids", () => {
  const mesh = block(4, 2, 2);
  const shown = allCells(mesh.regions.length);
  cutAway(centroidsOf(mesh), [{ normal: [1, 0, 0], offset: 3 }], shown);
  assert.equal(shown.reduce((sum, cell) => sum + cell), 3 * 2 * 2 * 6);
  const faces = boundaryOf(mesh.cells, neighbors(mesh), shown);
  assert.equal(faces.cut.reduce((sum, cut) => sum + cut), 2 * 2 * 2);
});

test("two planes take a quarter away, and no plane nothing", () => {
  const mesh = block(2, 2, 1);
  const quarter = allCells(24);
  cutAway(centroidsOf(mesh), [{ normal: [1, 0, 0], offset: 1 }, { normal: [0, -1, 0], offset: -1 }], quarter);
  assert.equal(quarter.reduce((sum, cell) => sum + cell), 18);
  const whole = allCells(24);
  cutAway(centroidsOf(mesh), [], whole);
  assert.equal(whole.reduce((sum, cell) => sum + cell), 24);
});

test("the extent of a block is its size", () => {
  assert.deepEqual(extentAlong(block(4, 3, 2).points, [0, -1, 0]), { low: -3, high: 0 });
  assert.deepEqual(extentAlong(new Float32Array(0), [0, 1, 0]), { low: 0, high: 0 });
});

test("the worst cells come first, those without volume before all", () => {
  const r = new Float32Array([1.5, Infinity, 1, 3, Infinity, 2]);
  const order = worstFirst(r, true);
  assert.deepEqual([...order.slice(2)], [3, 5, 0, 2]);
  assert.deepEqual([...order.slice(0, 2)].sort(), [1, 4]);
  assert.equal(countWorseThan(r, order, 2, true), 3);
  const shown = new Uint8Array([1, 1, 1, 0, 1, 1]);
  keepOnly(order, 4, shown);
  assert.deepEqual([...shown], [0, 1, 0, 0, 1, 1]);
});

test("the smallest angles are the worst", () => {
  const angles = new Float32Array([30, 10, 50, 20]);
  const order = worstFirst(angles, false);
  assert.deepEqual([...order], [1, 3, 0, 2]);
  assert.equal(countWorseThan(angles, order, 20, false), 1);
  assert.equal(countWorseThan(angles, order, 5, false), 0);
  assert.equal(countWorseThan(angles, order, 60, false), 4);
});
