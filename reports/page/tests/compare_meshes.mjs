/**
 * Are the meshes in a page those of its folder? There they are packed more densely:
 *
 *   node compare_meshes.mjs FOLDER
 *
 * Ends with 1 if one of them has another tetrahedron, region or vertex, or there is none.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { unpackMesh } from "../src/viewer/kept_mesh.mjs";

const MOST_STEPS = 0.51; // that rounding may move a coordinate
const ROUNDING = 1e-6; // of single precision, relative

const [folder] = process.argv.slice(2);
const page = readFileSync(join(folder, "index.html"), "utf8");
const embedded = JSON.parse(/id="ccdt-meshes">([^]*?)<\/script>/.exec(page)[1]);

/** Is it an even permutation of four numbers? */
const isEven = (order) => {
  let swaps = 0;
  for (let i = 0; i < 4; ++i) for (let j = i + 1; j < 4; ++j) swaps += order[i] > order[j];
  return swaps % 2 === 0;
};

/** What a mesh consists of, whatever the order: vertices of each tetrahedron sorted, its orientation, its region. */
function tetrahedraOf({ cells, regions, numbers }) {
  return Array.from(regions, (region, cell) => {
    const vertices = Array.from(cells.subarray(4 * cell, 4 * cell + 4), (vertex) => numbers[vertex]);
    return `${[...vertices].sort((a, b) => a - b)} ${isEven(vertices)} ${region}`;
  }).sort();
}

function problemOf(plain, compact, step) {
  const [expected, found] = [plain, compact].map(tetrahedraOf);
  if (expected.length !== found.length) return `${found.length} tetrahedra instead of ${expected.length}`;
  const other = expected.findIndex((words, i) => words !== found[i]);
  if (other >= 0) return `tetrahedron ${found[other]} instead of ${expected[other]}`;
  for (const [vertex, number] of compact.numbers.entries())
    for (let axis = 0; axis < 3; ++axis) {
      const [is, was] = [compact.points[3 * vertex + axis], plain.points[3 * number + axis]];
      if (Math.abs(is - was) > MOST_STEPS * step + ROUNDING * Math.abs(was)) return `vertex ${number} is at ${is} instead of ${was}`;
    }
  return "";
}

let wrong = 0;
for (const [file, kept] of Object.entries(embedded)) {
  const problem = problemOf(await unpackMesh(JSON.parse(readFileSync(join(folder, file), "utf8"))), await unpackMesh(kept), kept.step);
  if (problem) console.error(`${file}: ${problem}`);
  wrong += problem !== "";
}
const count = Object.keys(embedded).length;
console.log(`${count} meshes, ${wrong} of them not as in the folder`);
process.exitCode = wrong > 0 || count === 0 ? 1 : 0;
