import assert from "node:assert/strict";
import { test } from "node:test";
import { inLines } from "../src/charts/labels.mjs";
import { completeSpec } from "../src/charts/spec.mjs";

const columns = [
  { name: "model", kind: "label" },
  { name: "mesher", kind: "label" },
  { name: "seconds", kind: "time" },
];
const rows = [
  ["piston", "tetgen", 2],
  ["anchor", "ccdt", 1],
  ["piston", "ccdt", 1],
].map(([model, mesher, seconds]) => ({ values: { model, mesher, seconds }, runs: [] }));
const section = { tables: [{ name: "times", columns, rows }] };
const chart = {
  tables: ["times"],
  spec: {
    data: { name: "times" },
    facet: { field: "model", type: "nominal" },
    columns: 3,
    spec: {
      mark: "point",
      encoding: {
        x: { field: "seconds.value", type: "quantitative", scale: { type: "log" } },
        color: { field: "mesher", type: "nominal" },
        shape: { field: "mesher", type: "nominal", scale: { range: ["circle", "square"] } },
      },
    },
  },
};
const encoding = (options) => completeSpec(section, chart, options).spec.encoding;

test("a chart's data are the rows that pass, and the chart itself is not changed", () => {
  const before = structuredClone(chart);
  const { datasets } = completeSpec(section, chart, { passes: (row) => row.values.mesher === "ccdt" });
  assert.deepEqual(
    datasets.times.map(({ model }) => model),
    ["anchor", "piston"],
  );
  assert.deepEqual(chart, before);
});

test("series have the colors of the theme, ours first", () => {
  const { domain, range } = encoding({ theme: "dark" }).color.scale;
  assert.deepEqual(domain, ["ccdt", "tetgen"]);
  assert.notDeepEqual(range, encoding({ theme: "light" }).color.scale.range);
  assert.deepEqual(encoding({ theme: "page" }).color.scale.range, ["var(--chart-blue)", "var(--chart-vermilion)"]);
});

test("a scale that a chart says itself is kept", () => {
  assert.deepEqual(encoding().shape.scale, { range: ["circle", "square"] });
});

test("series that a chart computes have the colors of the theme in the order of their domain", () => {
  const computed = { tables: ["times"], spec: { data: { name: "times" }, encoding: { color: { field: "stage", type: "nominal", scale: { domain: ["lattice", "ccdt"] } } } } };
  const { domain, range } = completeSpec(section, computed, { theme: "page" }).encoding.color.scale;
  assert.deepEqual(domain, ["lattice", "ccdt"]);
  assert.equal(range[1], "var(--chart-blue)");
});

test("facets come in the order of the table, as many side by side as there is room for", () => {
  const wide = completeSpec(section, chart, { width: 700 }),
    narrow = completeSpec(section, chart, { width: 300 });
  assert.deepEqual(wide.facet.sort, ["piston", "anchor"]);
  assert.deepEqual([wide.columns, narrow.columns], [2, 1]);
});

test("layers that name themselves are series", () => {
  const layered = {
    tables: ["times"],
    spec: {
      data: { name: "times" },
      layer: [
        { mark: "point", encoding: { color: { datum: "measured here" } } },
        { mark: "point", encoding: { color: { datum: "the paper" } } },
      ],
    },
  };
  for (const layer of completeSpec(section, layered).layer)
    assert.deepEqual(layer.encoding.color.scale.domain, ["measured here", "the paper"]);
});

test("a long name takes as many lines as it needs, and is never cut", () => {
  assert.deepEqual(inLines("CDT with face protection check", 80, 10), ["CDT with face", "protection check"]);
  assert.deepEqual(inLines("unsplittable", 10, 10), ["unsplittable"]);
});

test("linear axes start at zero, unless the chart says where", () => {
  const scaleOf = (x) => {
    const spec = { data: { name: "times" }, mark: "point", encoding: { x: { field: "seconds.value", type: "quantitative", ...x } } };
    return completeSpec(section, { tables: ["times"], spec }).encoding.x.scale;
  };
  assert.equal(scaleOf({}).domainMin, 0);
  assert.deepEqual(scaleOf({ scale: { domain: [1, 3] } }), { domain: [1, 3] });
  assert.equal(scaleOf({ scale: { type: "log" } }).domainMin, undefined);
});

test("the title of an axis that is longer than it takes several lines", () => {
  const y = { field: "seconds.value", type: "quantitative", title: "time of a whole case (s)" };
  const high = { tables: ["times"], spec: { data: { name: "times" }, height: 60, mark: "point", encoding: { y } } };
  assert.deepEqual(completeSpec(section, high).encoding.y.title, ["time of a", "whole case", "(s)"]);
});
