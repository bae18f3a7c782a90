import assert from "node:assert/strict";
import { test } from "node:test";
import { chartData, tableData } from "../src/charts/chart_data.mjs";
import { inSeriesOrder, seriesStyles } from "../src/charts/series.mjs";
import { textWidth } from "../src/charts/text_width.mjs";

const times = {
  name: "times",
  columns: [
    { name: "model", kind: "label" },
    { name: "seconds", kind: "time" },
    { name: "vertices", kind: "figure" },
  ],
  rows: [
    { values: { model: "piston", seconds: { value: 2, low: 1, high: 3 }, vertices: 10 }, runs: [] },
    { values: { model: "bracket", seconds: 4, vertices: 20 }, runs: [] },
    { values: { model: "pole", seconds: null, vertices: null }, runs: [] },
    { values: { model: "cube", seconds: { value: 5, low: null, high: null }, vertices: 30 }, runs: [] },
  ],
};

test("a measured time is an estimate in the data of a chart, whatever it was in the table", () => {
  assert.deepEqual(
    tableData(times).map((datum) => datum.seconds),
    [{ value: 2, low: 1, high: 3 }, { value: 4, low: 4, high: 4 }, null, { value: 5, low: 5, high: 5 }],
  );
});

test("data know their rows when a filter has left some out", () => {
  const data = tableData(times, (row) => row.values.model !== "piston");
  assert.deepEqual(
    data.map((datum) => datum._row),
    [1, 2, 3],
  );
});

test("a chart has a data set for each of its tables, and one of all", () => {
  const section = { tables: [times, { ...times, name: "more" }] };
  const data = chartData(section, { tables: ["times", "more", "unknown"], spec: {} });
  assert.deepEqual(
    Object.entries(data).map(([name, rows]) => [name, rows.length]),
    [
      ["times", 4],
      ["more", 4],
      ["unknown", 0],
      ["all", 8],
    ],
  );
});

test("a mesher looks the same whoever else is in the chart", () => {
  const [alone] = seriesStyles(["tetgen"]);
  const [, , among] = seriesStyles(["with check", "some other", "TetGen"]);
  assert.deepEqual(alone, among);
});

test("series of one chart differ in color, shape and dashes", () => {
  const styles = seriesStyles(["ccdt", "tetgen", "cgal-mesh3", "with check", "new mesher", "another"]);
  for (const part of ["color", "shape", "dash"])
    assert.equal(new Set(styles.map((style) => String(style[part]))).size, styles.length, part);
});

test("our own series come first, unknown ones last, as they come", () => {
  assert.deepEqual(inSeriesOrder(["zzz", "tetgen", "aaa", "ccdt", "zzz"]), ["ccdt", "tetgen", "zzz", "aaa"]);
});

test("text is as wide as in Arial", () => {
  assert.equal(textWidth("1.5", 1000), 556 + 278 + 556);
  assert.ok(textWidth("wide", 10, true) > textWidth("wide", 10));
});

test("a chart that wants only some rows has no others", () => {
  const section = {
    tables: [
      {
        name: "points",
        columns: [{ name: "mesher", kind: "label" }],
        rows: [{ values: { mesher: "ccdt" } }, { values: { mesher: "tetgen" } }],
      },
    ],
  };
  const data = chartData(section, { tables: ["points"], spec: { usermeta: { only: { mesher: "ccdt" } } } });
  assert.deepEqual(data.all.map(({ mesher }) => mesher), ["ccdt"]);
});
