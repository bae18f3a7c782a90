import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import Ajv from "ajv";
import addFormats from "ajv-formats";

const SCHEMA_FILE = /^(ccdt\.[a-z]+)\.(\d+)\.schema\.json$/;

// Two schemas of files that users write have alternatives with members in common.
const FOR_USERS = { strictRequired: false, strictTuples: false };

/**
 * The validators of all schemas of a folder, by the names that files give ("ccdt.run/1"). What a schema itself gets
 * wrong is an error too.
 */
export function validatorsOf(schemaFolder) {
  const names = readdirSync(schemaFolder).filter((name) => SCHEMA_FILE.test(name));
  const ajv = addFormats(new Ajv({ allErrors: true, allowUnionTypes: true, strict: true, ...FOR_USERS }));
  for (const name of names) ajv.addSchema(readJson(join(schemaFolder, name)), name); // they refer to each other by name
  const validators = new Map();
  for (const name of names) {
    const [, kind, version] = SCHEMA_FILE.exec(name);
    validators.set(`${kind}/${version}`, ajv.getSchema(name));
  }
  if (validators.size === 0) throw new Error(`${schemaFolder} has no schemas.`);
  return validators;
}

/** What is wrong with the JSON of one file; empty: nothing. */
export function problemsOf(json, validators) {
  if (json === null || typeof json !== "object") return ["is neither an object nor an array"];
  if (json.schema === undefined) return googleBenchmarkProblems(json);
  const validate = validators.get(json.schema);
  if (!validate) return [`has a schema that is not known: ${JSON.stringify(json.schema)}`];
  if (validate(json)) return [];
  return validate.errors.map(({ instancePath, message, params }) => `${instancePath || "/"} ${message} ${JSON.stringify(params)}`);
}

// Files of Google Benchmark have no schema; its tools ask for these two.
function googleBenchmarkProblems(json) {
  const problems = [];
  if (typeof json.context !== "object") problems.push("has neither a schema nor the context of Google Benchmark");
  if (!Array.isArray(json.benchmarks)) problems.push("has neither a schema nor the benchmarks of Google Benchmark");
  return problems;
}

/**
 * Checks every JSON file in a folder and the folders in it.
 * @returns {{file: string, kind: string, problems: string[]}[]} one per file; kind is the schema that it names
 */
export function checkFolder(folder, validators) {
  return jsonFilesIn(folder).map((file) => {
    try {
      const json = readJson(join(folder, file));
      return { file, kind: json?.schema ?? "Google Benchmark", problems: problemsOf(json, validators) };
    } catch (error) {
      return { file, kind: "not JSON", problems: [error.message] };
    }
  });
}

function jsonFilesIn(folder, inside = "") {
  const entries = readdirSync(join(folder, inside), { withFileTypes: true });
  return entries.flatMap((entry) => {
    const path = join(inside, entry.name);
    if (entry.isDirectory()) return jsonFilesIn(folder, path);
    return entry.name.endsWith(".json") ? [path] : [];
  });
}

const readJson = (file) => JSON.parse(readFileSync(file, "utf8"));
