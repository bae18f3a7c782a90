import assert from "node:assert/strict";
import { test } from "node:test";
import { rowFacts, rowTitle, saysUnit, sortedRows, unitText } from "../src/page/rows.mjs";

const table = {
  columns: [
    { name: "model", title: "model", kind: "label", unit: "" },
    { name: "mesher", title: "mesher", kind: "label", unit: "" },
    { name: "status", title: "status", kind: "label", unit: "" },
    { name: "seconds", title: "CDT", kind: "time", unit: "s" },
    { name: "reason", title: "reason", kind: "note", unit: "" },
  ],
};
const row = (model, seconds, more = {}) => ({
  values: { model, mesher: model, status: "ok", seconds, reason: null, ...more },
  runs: [],
});

test("a row is named by its labels, each once, without its status", () => {
  assert.equal(rowTitle(table, row("piston", 1)), "piston");
  assert.equal(rowTitle(table, row("piston", 1, { mesher: "ccdt" })), "piston, ccdt");
});

test("values come with their units, and missing ones are left out", () => {
  assert.deepEqual(rowFacts(table, row("piston", { value: 2, low: 1, high: 3 })), ["CDT: 2.0 [1.0, 3.0] s"]);
  assert.deepEqual(rowFacts(table, row("piston", null, { reason: "timeout" })), ["reason: timeout"]);
});

test("rows are sorted by values of estimates, and those without a value come last either way", () => {
  const rows = [row("a", null), row("b", { value: 10, low: 1, high: 19 }), row("c", 9)];
  const order = (descending) => sortedRows(rows, { name: "seconds", descending }).map(({ values }) => values.model);
  assert.deepEqual(order(false), ["c", "b", "a"]);
  assert.deepEqual(order(true), ["b", "c", "a"]);
});

test("numbers in texts are sorted as numbers", () => {
  const rows = ["size 10", "size 9"].map((model) => row(model, 1));
  assert.deepEqual(
    sortedRows(rows, { name: "model", descending: false }).map(({ values }) => values.model),
    ["size 9", "size 10"],
  );
});

test("without a sorting, rows stay as they come", () => {
  const rows = [row("b", 2), row("a", 1)];
  assert.deepEqual(sortedRows(rows, null), rows);
});

test("a unit is not said twice", () => {
  assert.ok(saysUnit({ title: "microseconds a vertex", unit: "us" }));
  assert.ok(saysUnit({ title: "vertices", unit: "" }));
  assert.ok(!saysUnit({ title: "slope", unit: "us" }));
  assert.equal(unitText("us"), "µs");
});
