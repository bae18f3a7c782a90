import { counted, numberText } from "./numbers.mjs";
import { rowFacts, rowTitle } from "./rows.mjs";

/** The facts of the one row that a mark represents. */
function factsOfRow(section, datum) {
  const table = section.tables.find(({ name }) => name === datum._table);
  const row = table?.rows[datum._row];
  return row ? { title: rowTitle(table, row) || table.title, facts: rowFacts(table, row), runs: row.runs } : null;
}

/** The facts of all rows of the chart's first table that have the values of a cell, by `usermeta.cells`. */
function factsOfCell(section, chart, datum, passes) {
  const { cells, only = {} } = chart.spec.usermeta;
  const table = section.tables.find(({ name }) => name === chart.tables[0]);
  const wanted = { ...only, ...Object.fromEntries(cells.map((name) => [name, datum[name]])) };
  const rows = table.rows.filter(
    (row) => Object.entries(wanted).every(([name, value]) => row.values[name] === value) && passes(row, table),
  );
  const facts = [counted(rows.length, "row")];
  if (datum.middle !== undefined) facts.unshift(`median: ${numberText(datum.middle)}`);
  return { title: cells.map((name) => datum[name]).join(", "), facts, runs: rows.flatMap(({ runs }) => runs) };
}

/**
 * The facts about a mark of a chart, and the runs behind it.
 * @returns {{title: string, facts: string[], runs: string[]}|null}
 */
export function factsOf(section, chart, datum, passes) {
  if (!datum) return null;
  if (datum._table !== undefined) return factsOfRow(section, datum);
  const cells = chart.spec.usermeta?.cells;
  return cells?.every((name) => datum[name] !== undefined) ? factsOfCell(section, chart, datum, passes) : null;
}
