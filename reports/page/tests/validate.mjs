/**
 * Validates each JSON file in a folder against the schema that it names, with a validator that shares nothing with the
 * program that wrote it:
 *
 *   node validate.mjs FOLDER SCHEMA_FOLDER
 *
 * Ends with 1 if a file is not valid, or there is none.
 */
import { checkFolder, validatorsOf } from "./json_validation.mjs";

const [folder, schemaFolder] = process.argv.slice(2);
if (!folder || !schemaFolder) {
  console.error("usage: node validate.mjs FOLDER SCHEMA_FOLDER");
  process.exit(2);
}

const results = checkFolder(folder, validatorsOf(schemaFolder));
for (const { file, problems } of results) for (const problem of problems) console.error(`${file}: ${problem}`);

const counts = new Map();
for (const { kind } of results) counts.set(kind, (counts.get(kind) ?? 0) + 1);
const invalid = results.filter(({ problems }) => problems.length > 0).length;
const kinds = [...counts].map(([kind, count]) => `${count} ${kind}`).join(", ");
console.log(`${results.length} JSON files (${kinds}), ${invalid} of them not valid`);
process.exitCode = invalid > 0 || results.length === 0 ? 1 : 0;
