import { cellText, sortKey } from "./numbers.mjs";

/** The column that says whether a row's runs went well. */
export const STATUS = "status";

const UNIT_WORDS = {
  s: "second",
  ms: "millisecond",
  us: "microsecond",
  µs: "microsecond",
  "°": "degree",
  degrees: "degree",
  "%": "percent",
};

/** Is there no unit, or is it in the title already? */
export function saysUnit({ title, unit }) {
  return !unit || title.includes(UNIT_WORDS[unit] ?? unit);
}

/** A unit as it is printed. */
export function unitText(unit) {
  return unit === "us" ? "µs" : unit;
}

/** "piston, with check": what a row describes. */
export function rowTitle(table, row) {
  const labels = table.columns
    .filter(({ name, kind }) => kind === "label" && name !== STATUS && row.values[name])
    .map(({ name }) => row.values[name]);
  return [...new Set(labels)].join(", ");
}

/** Everything that a row says, for the trace and the tooltips of charts. */
export function rowFacts(table, row) {
  return table.columns
    .filter(({ name, kind }) => kind !== "label" && sortKey(row.values[name]) !== null)
    .map(({ name, title, unit }) => `${title}: ${cellText(row.values[name])}${unit ? ` ${unitText(unit)}` : ""}`);
}

function compare(a, b) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

/**
 * Rows in another order; what has no value comes last, whichever way.
 * @param {object[]} rows
 * @param {{name: string, descending: boolean}|null} sorting  by which column; null: not sorted
 */
export function sortedRows(rows, sorting) {
  if (sorting === null) return rows;
  const { name, descending } = sorting;
  const keyed = rows.map((row) => ({ row, key: sortKey(row.values[name]) }));
  keyed.sort((a, b) =>
    a.key === null || b.key === null ? compare(a.key, b.key) : (descending ? -1 : 1) * compare(a.key, b.key),
  );
  return keyed.map(({ row }) => row);
}
