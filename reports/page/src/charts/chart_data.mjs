/**
 * The data sets of a chart: for each of its tables the values of its rows. A measured time is always an estimate here,
 * so that "seconds.value" can be relied on. `_table` and `_row` tell where a datum comes from.
 * The data set "all" has those of all tables together, for facets of more than one.
 */

/** @returns {object} the value of a time's cell as an estimate; its interval has no width if there is none */
function asEstimate(cell) {
  const { value, low, high } = typeof cell === "number" ? { value: cell } : (cell ?? {});
  return value === undefined ? cell : { value, low: low ?? value, high: high ?? value };
}

/**
 * @param {object} table
 * @param {(row: object) => boolean} passes  the filter
 * @param {(column: object) => boolean} isUsed  which columns data have
 * @returns {object[]}
 */
export function tableData(table, passes = () => true, isUsed = () => true) {
  const columns = table.columns.filter(isUsed).map(({ name, kind }) => ({ name, isTime: kind === "time" }));
  const data = [];
  table.rows.forEach((row, index) => {
    if (!passes(row)) return;
    const values = {};
    for (const { name, isTime } of columns) values[name] = isTime ? asEstimate(row.values[name]) : row.values[name];
    values._table = table.name;
    values._row = index;
    data.push(values);
  });
  return data;
}

const MANY_ROWS = 500; // of which data have only what the chart names

function usedColumns(chart, table) {
  if (table.rows.length <= MANY_ROWS) return () => true;
  const words = JSON.stringify(chart.spec);
  return ({ name }) => words.includes(name);
}

/** @returns {boolean} whether a row is among those that the chart itself wants, by `usermeta.only` */
function isWanted(chart, row) {
  return Object.entries(chart.spec.usermeta?.only ?? {}).every(([name, value]) => row.values[name] === value);
}

/**
 * @param {object} section  of a report
 * @param {object} chart    one of its charts
 * @param {(row: object, table: object) => boolean} passes
 * @returns {Object<string, object[]>} data sets by name
 */
export function chartData(section, chart, passes = () => true) {
  const sets = {};
  for (const name of chart.tables) {
    const table = section.tables.find((one) => one.name === name);
    sets[name] = table
      ? tableData(table, (row) => isWanted(chart, row) && passes(row, table), usedColumns(chart, table))
      : [];
  }
  sets.all = Object.values(sets).flat();
  return sets;
}
