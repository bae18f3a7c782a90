import assert from "node:assert/strict";
import { test } from "node:test";
import { labeledValues } from "../src/charts/log_axes.mjs";

const FONT = 10;
const across = (domain, length) => labeledValues(domain, length, true, FONT);

test("a logarithmic axis over decades is labeled at powers of ten, as many as have room", () => {
  assert.deepEqual(across([0.5, 2e4], 300), [1, 10, 100, 1000, 10000]);
  assert.deepEqual(across([1, 1e6], 120), [1, 1000, 1000000]);
});

test("with little more than a decade, numbers between the powers of ten are labeled", () => {
  assert.deepEqual(across([800, 22000], 280), [1000, 2000, 5000, 10000, 20000]);
});

test("with less than a decade, equal steps are labeled", () => {
  assert.deepEqual(across([0.95, 1.06], 250), [0.96, 0.98, 1, 1.02, 1.04, 1.06]);
});

test("numbers far from 1 are labeled, whatever their last bits are", () => {
  assert.deepEqual(across([1e-7, 1e-3], 400), [1e-7, 1e-6, 1e-5, 1e-4, 1e-3]);
});

test("an axis without an extent has no labels between its ends", () => {
  assert.deepEqual(across([1, 1], 300), [1, 1]);
});
