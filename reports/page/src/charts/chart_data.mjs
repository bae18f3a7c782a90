/**
 * The data sets of a chart: for each of its tables the values of its rows. A measured time is always an estimate here,
 * so that "seconds.value" can be relied on. `_table` and `_row` tell where a datum comes from.
 * The data set "all" has those of all tables together, for facets of more than one.
 */

/** @returns {object} the value of a time's cell as an estimate */
function asEstimate(cell) {
  return typeof cell === "number" ? { value: cell, low: cell, high: cell } : cell;
}

/**
 * @param {object} table
 * @param {(row: object) => boolean} passes  the filter
 * @returns {object[]}
 */
export function tableData(table, passes = () => true) {
  const times = table.columns.filter((column) => column.kind === "time").map((column) => column.name);
  return table.rows
    .map((row, index) => ({ row, index }))
    .filter(({ row }) => passes(row))
    .map(({ row, index }) => {
      const values = { ...row.values, _table: table.name, _row: index };
      for (const name of times) values[name] = asEstimate(values[name]);
      return values;
    });
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
    sets[name] = table ? tableData(table, (row) => isWanted(chart, row) && passes(row, table)) : [];
  }
  sets.all = Object.values(sets).flat();
  return sets;
}
