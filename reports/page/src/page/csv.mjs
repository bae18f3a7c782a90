/** Spreadsheets take a text for a formula if it begins with one of these. The program's own CSV does the same. */
const FORMULA = /^[=+\-@\t\r\n]/;

function quoted(value) {
  if (value === null || value === undefined) return "";
  const text = typeof value === "string" && FORMULA.test(value) ? `'${value}` : String(value);
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** A time may be an estimate; then it has three columns. */
function isEstimated(table, column) {
  return table.rows.some((row) => typeof row.values[column.name] === "object" && row.values[column.name] !== null);
}

function cellsOf(cell, estimated) {
  if (!estimated) return [cell];
  return typeof cell === "object" && cell !== null ? [cell.value, cell.low, cell.high] : [cell, null, null];
}

/**
 * A table as CSV (RFC 4180): all digits, an estimate in three columns, the run files in the last.
 * @param {object} table
 * @param {object[]} rows  of it
 */
export function csvOf(table, rows = table.rows) {
  const columns = table.columns.map((column) => ({ ...column, estimated: isEstimated(table, column) }));
  const head = columns.flatMap(({ name, estimated }) => (estimated ? [name, `${name}_low`, `${name}_high`] : [name]));
  const lines = rows.map((row) => [
    ...columns.flatMap(({ name, estimated }) => cellsOf(row.values[name], estimated)),
    row.runs.join(" "),
  ]);
  return [[...head, "runs"], ...lines].map((line) => line.map(quoted).join(",")).join("\r\n") + "\r\n";
}
