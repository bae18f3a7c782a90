import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import Ajv from "ajv";
import addFormats from "ajv-formats";
import { drawn } from "../src/charts/draw.mjs";
import { measureWithoutCanvas } from "../src/charts/measure_text.mjs";
import { madeUpReport } from "./fixture/report.mjs";

measureWithoutCanvas();
const folder = join(process.env.CCDT_REPORTS, "charts");
const { report } = madeUpReport(folder);
const all = report.experiments.flatMap((section) => section.charts.map((chart) => ({ section, chart })));

function marksOf(item) {
  const own =
    item.marktype && !["group", "text"].includes(item.marktype) && item.role === "mark" ? item.items.length : 0;
  return (item.items ?? []).reduce((sum, child) => sum + marksOf(child), own);
}

test("every chart is drawn from some experiment", () => {
  const files = readdirSync(folder).filter((name) => name.endsWith(".json") && name !== "config.json");
  const fileOf = ({ section, chart }) => `${section.name}-${chart.name.replace(/-lattice-locator$/, "")}.json`;
  assert.deepEqual(all.map(fileOf).sort(), files.sort());
});

// The schema is large, and used a few times only.
const COMPILED_FAST = { strict: false, validateSchema: false, inlineRefs: false, code: { optimize: false } };

test("charts are valid Vega-Lite", () => {
  const file = createRequire(import.meta.url).resolve("vega-lite/vega-lite-schema.json");
  const ajv = addFormats(new Ajv(COMPILED_FAST)).addFormat("color-hex", () => true);
  const validate = ajv.compile(JSON.parse(readFileSync(file, "utf8")));
  for (const { section, chart } of all)
    assert.ok(validate(chart.spec), `${section.name}/${chart.name}: ${JSON.stringify(validate.errors?.slice(0, 3))}`);
});

const PHONE = 358;

for (const { section, chart } of all) {
  test(`${section.name}/${chart.name} is drawn with its data, as wide as a phone, without warnings`, async () => {
    const { view, warnings } = await drawn(section, chart, { width: PHONE });
    assert.deepEqual(warnings, []);
    assert.ok(marksOf(view.scenegraph().root) > 3);
    const width = Number(/ width="([\d.]+)"/.exec(await view.toSVG())[1]);
    assert.ok(width <= PHONE && width > PHONE - 12, `${width} for ${PHONE}`);
    view.finalize();
  });
}
