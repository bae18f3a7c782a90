import assert from "node:assert/strict";
import { test } from "node:test";
import { csvOf } from "../src/page/csv.mjs";

const table = {
  columns: [{ name: "model" }, { name: "seconds" }, { name: "reason" }],
  rows: [
    {
      values: { model: "piston", seconds: { value: 2.5, low: 2, high: 3 }, reason: null },
      runs: ["runs/a.json", "runs/b.json"],
    },
    { values: { model: 'a, "b"', seconds: null, reason: "two\nlines" }, runs: [] },
  ],
};

test("an estimate takes three columns, and its runs are in the last one", () => {
  const [head, first] = csvOf(table).split("\r\n");
  assert.equal(head, "model,seconds,seconds_low,seconds_high,reason,runs");
  assert.equal(first, "piston,2.5,2,3,,runs/a.json runs/b.json");
});

test("commas, quotes and line ends are kept in quotes", () => {
  assert.ok(csvOf(table).includes('"a, ""b""",,,,"two\nlines",\r\n'));
});

test("a text is no formula, and a negative number stays a number", () => {
  const row = { values: { model: "=1+1", seconds: -2, reason: "@a" }, runs: [] };
  assert.ok(csvOf({ ...table, rows: [row] }).endsWith("'=1+1,-2,'@a,\r\n"));
});

test("only the rows that are shown are written", () => {
  assert.equal(csvOf(table, table.rows.slice(0, 1)).split("\r\n").length, 3);
});
