import assert from "node:assert/strict";
import test from "node:test";

import { meshPicture } from "../src/viewer/mesh_picture.mjs";
import { colorOf, MEASURES, regionColors } from "../src/viewer/palette.mjs";
import { visibleFaces } from "../src/viewer/visible_faces.mjs";
import { block, kept, meshOf, twoTetrahedra } from "./small_meshes.mjs";

const fills = (svg) => [...svg.matchAll(/fill="(#[0-9a-f]{6})"/g)].map((match) => match[1]);
const isReddish = (color) => parseInt(color.slice(1, 3), 16) > parseInt(color.slice(5, 7), 16);

test("a block cut open shows blue outside and orange inside", async () => {
  const colors = fills(await meshPicture(kept(block(4, 4, 4))));
  assert.ok(colors.some(isReddish));
  assert.ok(colors.some((color) => !isReddish(color)));
});

test("a picture has no faces that others hide", async () => {
  const size = 6;
  const mesh = block(size, size, size);
  const count = fills(await meshPicture(kept(mesh))).length;
  const allOutside = 2 * 6 * size * size;
  assert.ok(count > 0 && count <= allOutside / 2, `${count} of ${allOutside} faces`);
});

test("a title cannot break the picture", async () => {
  const svg = await meshPicture(kept({ ...block(1, 1, 1), title: "a < b & c" }));
  assert.ok(svg.includes("<title>a &lt; b &amp; c, cut open</title>"));
});

test("a mesh without tetrahedra is an empty picture", async () => {
  const svg = await meshPicture(kept(meshOf([], [])));
  assert.deepEqual(fills(svg), []);
  assert.ok(!svg.includes("NaN"));
});

test("of two triangles one behind the other only the front one is seen", () => {
  const triangle = (depth) => [10, 10, depth, 10, 40, depth, 40, 10, depth];
  const coordinates = new Float32Array([...triangle(0), ...triangle(1)]);
  assert.deepEqual(visibleFaces(new Uint32Array([0, 1, 2, 3, 4, 5]), coordinates, 50, 50), [1]);
  assert.deepEqual(visibleFaces(new Uint32Array([0, 1, 2, 5, 4, 3]), coordinates, 50, 50), [0]);
});

test("what is seen comes from far to near", () => {
  const triangle = (x, depth) => [x, 10, depth, x, 20, depth, x + 10, 10, depth];
  const coordinates = new Float32Array([...triangle(0, 5), ...triangle(20, -5), ...triangle(40, 0)]);
  assert.deepEqual(visibleFaces(new Uint32Array([0, 1, 2, 3, 4, 5, 6, 7, 8]), coordinates, 60, 30), [1, 2, 0]);
});

test("regions have colors of their own, in the order of their numbers", () => {
  const colors = regionColors(twoTetrahedra.regions);
  assert.deepEqual([...colors.keys()], [1, 7]);
  assert.notEqual(colors.get(1).surface, colors.get(7).surface);
  assert.notEqual(colors.get(1).cut, colors.get(7).cut);
});

test("good cells are lighter than bad ones, and the scale ends where it says", () => {
  const lightness = (color) => [1, 3, 5].reduce((sum, at) => sum + parseInt(color.slice(at, at + 2), 16), 0);
  for (const measure of Object.values(MEASURES)) {
    const half = (measure.best + measure.worst) / 2;
    const [best, middle, worst] = [measure.best, half, measure.worst].map((value) => colorOf(measure, value));
    assert.ok(lightness(best) > lightness(middle) && lightness(middle) > lightness(worst));
    assert.equal(colorOf(measure, measure.worst + (measure.worst - measure.best)), worst);
  }
  assert.equal(colorOf(MEASURES.r, Infinity), colorOf(MEASURES.r, 3));
});
