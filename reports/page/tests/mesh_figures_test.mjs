import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import { meshFigures } from "../src/figures/mesh_figures.mjs";
import { block, kept } from "./small_meshes.mjs";

test("meshes kept for a picture are drawn, and those that cannot be read are named", async () => {
  const folder = mkdtempSync(join(tmpdir(), "ccdt-figures-"));
  try {
    mkdirSync(join(folder, "meshes"));
    writeFileSync(join(folder, "meshes", "cube.json"), JSON.stringify(kept(block(2, 2, 2))));
    const mesh = (file, figure) => ({ file, title: file, run: "runs/a.json", figure });
    const experiments = [
      { name: "fig7", meshes: [mesh("meshes/cube.json", true), mesh("meshes/absent.json", true)] },
      { name: "quality", meshes: [mesh("meshes/cube.json", false)] },
    ];
    const { figures, trouble } = await meshFigures({ experiments }, folder);
    assert.deepEqual(figures.map(({ name }) => name), ["fig7-cube"]);
    assert.match(figures[0].svg, /^<svg .*<path /s);
    assert.equal(trouble.length, 1);
    assert.match(trouble[0], /^meshes\/absent\.json: /);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
