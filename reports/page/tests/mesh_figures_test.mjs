import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import { figureNames } from "../src/figures/figure_name.mjs";
import { meshFigures } from "../src/figures/mesh_figures.mjs";
import { block, kept } from "./small_meshes.mjs";

test("meshes kept for a picture are drawn, and those that cannot be read are named", async () => {
  const folder = mkdtempSync(join(tmpdir(), "ccdt-figures-"));
  try {
    mkdirSync(join(folder, "meshes"));
    writeFileSync(join(folder, "meshes", "cube.json"), JSON.stringify(kept(block(2, 2, 2))));
    const mesh = (file, title, figure) => ({ file, title, run: "runs/a.json", figure });
    const experiments = [
      { name: "fig7", meshes: [mesh("meshes/cube.json", "Large cube", true), mesh("meshes/absent.json", "ball", true)] },
      { name: "quality", meshes: [mesh("meshes/cube.json", "Large cube", false)] },
    ];
    const { figures, trouble } = await meshFigures({ experiments }, folder);
    assert.deepEqual(figures.map(({ name }) => name), ["fig7-large-cube"]);
    assert.match(figures[0].svg, /^<svg .*<path /s);
    assert.equal(trouble.length, 1);
    assert.match(trouble[0], /^meshes\/absent\.json: /);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("figures are named by what they show, and different figures differently", () => {
  assert.deepEqual(figureNames("fig7", ["piston", "stepping pole", "piston"]), ["fig7-piston", "fig7-stepping-pole", "fig7-piston-2"]);
});
