import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import Ajv from "ajv";
import { madeUpReport } from "./fixture/report.mjs";

const reports = process.env.CCDT_REPORTS;

test("the made-up report is one of schema ccdt.report/1", () => {
  const schema = JSON.parse(readFileSync(join(reports, "ccdt.report.1.schema.json"), "utf8"));
  const validate = new Ajv({ allErrors: true }).compile(schema);
  assert.ok(validate(madeUpReport(join(reports, "charts")).report), JSON.stringify(validate.errors));
});
