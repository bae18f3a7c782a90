import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import { checkFolder, problemsOf, validatorsOf } from "./json_validation.mjs";
import { kept, regularTetrahedron } from "./small_meshes.mjs";

const validators = validatorsOf(process.env.CCDT_SCHEMAS);
const mesh = kept(regularTetrahedron);

test("every published schema is one that the validator takes, those of reports among them", () => {
  const files = readdirSync(process.env.CCDT_SCHEMAS).filter((name) => name.endsWith(".schema.json"));
  assert.equal(validators.size, files.length);
  for (const kind of ["claims", "experiment", "mesh", "report", "run"]) assert.ok(validators.has(`ccdt.${kind}/1`), kind);
});

test("a file is valid only with all that its schema asks for", () => {
  assert.deepEqual(problemsOf(mesh, validators), []);
  const { cells, ...withoutCells } = mesh;
  assert.match(problemsOf(withoutCells, validators).join(), /cells/);
  assert.match(problemsOf({ ...mesh, vertices: -1 }, validators).join(), /\/vertices must be >= 0/);
});

test("a schema that is not known is a problem", () => {
  assert.match(problemsOf({ schema: "ccdt.mesh/2" }, validators).join(), /not known/);
});

test("files of Google Benchmark have a context and benchmarks", () => {
  assert.deepEqual(problemsOf({ context: {}, benchmarks: [] }, validators), []);
  assert.equal(problemsOf({}, validators).length, 2);
});

test("the files of a folder are found at every depth", () => {
  const folder = mkdtempSync(join(tmpdir(), "ccdt-validation-"));
  try {
    mkdirSync(join(folder, "meshes"));
    writeFileSync(join(folder, "meshes", "good.json"), JSON.stringify(mesh));
    writeFileSync(join(folder, "broken.json"), "{");
    writeFileSync(join(folder, "note.txt"), "{");
    const results = checkFolder(folder, validators);
    assert.deepEqual(results.map(({ file }) => file).sort(), ["broken.json", join("meshes", "good.json")]);
    assert.deepEqual(results.filter(({ problems }) => problems.length > 0).map(({ file }) => file), ["broken.json"]);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
