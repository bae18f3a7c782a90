import assert from "node:assert/strict";
import { test } from "node:test";
import { choicesOf, isFiltering, openFilters, passes, rangesOf } from "../src/page/filters.mjs";

const row = (values) => ({ values, runs: [] });
const points = {
  name: "points",
  data: false,
  columns: [
    { name: "model", title: "model", kind: "label" },
    { name: "mesher", title: "mesher", kind: "label" },
    { name: "edge_length", title: "edge length", kind: "figure" },
    { name: "vertices", title: "vertices", kind: "figure" },
  ],
  rows: [
    row({ model: "piston", mesher: "ccdt", edge_length: 2, vertices: 900 }),
    row({ model: "bracket", mesher: "ccdt", edge_length: 1, vertices: 7000 }),
    row({ model: "piston", mesher: "ccdt", edge_length: 1, vertices: null }),
  ],
};
const lines = {
  name: "lines",
  data: true,
  columns: [points.columns[0], points.columns[3]],
  rows: [row({ model: "pole", vertices: 900 }), row({ model: "", vertices: 7000 })],
};
const section = { tables: [points, lines] };

test("labels of at least two values are choices, over all tables, and sizes too", () => {
  assert.deepEqual(
    choicesOf(section).map(({ name, values }) => [name, values]),
    [
      ["model", ["piston", "bracket", "pole"]],
      ["edge_length", ["2", "1"]],
    ],
  );
});

test("a label of very many values is no choice", () => {
  const many = {
    ...points,
    rows: Array.from({ length: 21 }, (_, number) => row({ model: `m${number}`, mesher: number % 2 ? "a" : "b" })),
  };
  assert.deepEqual(
    choicesOf({ tables: [many] }).map(({ name }) => name),
    ["mesher"],
  );
});

test("a range of sizes has round ends that all sizes are within", () => {
  assert.deepEqual(rangesOf(section), [
    { name: "vertices", title: "vertices", bounds: [500, 1000, 2000, 5000, 10000] },
  ]);
});

test("sizes that hardly differ, or are in data tables alone, are no range", () => {
  const similar = { ...points, rows: points.rows.map(({ values }) => row({ ...values, vertices: 1000 })) };
  assert.deepEqual(rangesOf({ tables: [similar, lines] }), []);
});

test("all passes at first", () => {
  const state = openFilters();
  assert.ok(points.rows.every((one) => passes(state, one, points)));
  assert.equal(isFiltering(state), false);
});

test("what is left out does not pass, in any table that has the label", () => {
  const state = openFilters();
  state.without.set("model", new Set(["piston", "pole"]));
  assert.equal(isFiltering(state), true);
  assert.deepEqual(
    points.rows.map((one) => passes(state, one, points)),
    [false, true, false],
  );
  assert.deepEqual(
    lines.rows.map((one) => passes(state, one, lines)),
    [false, true],
  );
});

test("a size is left out by its number", () => {
  const state = openFilters();
  state.without.set("edge_length", new Set(["1"]));
  assert.deepEqual(
    points.rows.map((one) => passes(state, one, points)),
    [true, false, false],
  );
});

test("a range holds back other sizes, but not rows without one, nor data tables", () => {
  const state = openFilters();
  state.ranges.set("vertices", { low: 1000, high: 10000 });
  assert.deepEqual(
    points.rows.map((one) => passes(state, one, points)),
    [false, true, true],
  );
  assert.deepEqual(
    lines.rows.map((one) => passes(state, one, lines)),
    [true, true],
  );
});
