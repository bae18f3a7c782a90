import assert from "node:assert/strict";
import { test } from "node:test";
import { cellText, commonDecimals, counted, estimateTexts, numberText, sortKey } from "../src/page/numbers.mjs";

test("whole numbers have separators and no decimals", () => {
  assert.equal(numberText(1234567), "1,234,567");
  assert.equal(numberText(0), "0");
});

test("other numbers have four significant digits", () => {
  assert.equal(numberText(3.14159), "3.142");
  assert.equal(numberText(0.0123456), "0.01235");
  assert.equal(numberText(12345.678), "12,346");
});

test("what is rounded to zero has no sign", () => {
  assert.equal(numberText(-0.004, 1), "0.0");
});

test("very small numbers have an exponent", () => {
  assert.equal(numberText(0.0000123), "1.23×10⁻⁵");
  assert.equal(numberText(-0.0000123), "-1.23×10⁻⁵");
});

test("what is no number is a dash", () => {
  for (const nothing of [null, undefined, Number.NaN, Number.POSITIVE_INFINITY]) assert.equal(numberText(nothing), "–");
  assert.equal(cellText(""), "–");
});

test("an estimate has the digits that its interval deserves", () => {
  assert.deepEqual(estimateTexts({ value: 1.03142, low: 1.02443, high: 1.03941 }), {
    value: "1.031",
    interval: "[1.024, 1.039]",
  });
  assert.deepEqual(estimateTexts({ value: 602.251, low: 590.11, high: 617.93 }), {
    value: "602",
    interval: "[590, 618]",
  });
  assert.equal(cellText({ value: 8.05, low: 7.9, high: 8.2 }), "8.05 [7.90, 8.20]");
});

test("an estimate without width has no interval", () => {
  assert.deepEqual(estimateTexts({ value: 2.5, low: 2.5, high: 2.5 }), { value: "2.500", interval: "" });
  assert.deepEqual(estimateTexts({ value: 2.5, low: null, high: null }), { value: "2.500", interval: "" });
});

test("the numbers of a column have as many decimals as each other", () => {
  assert.equal(commonDecimals([1, 20, null, "x"]), 0);
  assert.equal(commonDecimals([1.27, 1.4512]), 3);
  assert.equal(commonDecimals([25.53, 602.25]), 1);
  assert.equal(commonDecimals([0.001, 5000.5]), undefined);
});

test("an estimate is sorted by its value, and nothing comes as null", () => {
  assert.equal(sortKey({ value: 3, low: 1, high: 9 }), 3);
  assert.equal(sortKey("text"), "text");
  assert.equal(sortKey(""), null);
  assert.equal(sortKey(undefined), null);
});

test("one is not plural", () => {
  assert.equal(counted(1, "run"), "1 run");
  assert.equal(counted(1200, "run"), "1,200 runs");
});
