/**
 * Filters of a section: which rows of its tables, and so which data of its charts, are shown.
 *
 * A choice is made among the values of a label, in all tables that have it. A range is of sizes. Rows that do not have
 * the column, or have nothing in it, pass.
 */

const MOST_VALUES = 20;
const SIZES = ["edge_length"]; // figures that are chosen like labels
const RANGES = ["vertices"]; // figures of which a range is chosen
const SMALLEST_SPREAD = 4; // largest over smallest, for a range to make sense

/**
 * @typedef {object} Choice
 * @property {string} name    of the column
 * @property {string} title
 * @property {string[]} values  in the order of the tables
 *
 * @typedef {object} Range
 * @property {string} name
 * @property {string} title
 * @property {number[]} bounds  ascending: what can be chosen as an end
 *
 * @typedef {{without: Map<string, Set<string>>, ranges: Map<string, {low: number, high: number}>}} FilterState
 */

function isThere(cell) {
  return cell !== null && cell !== undefined && cell !== "";
}

function cellsOf(tables, name) {
  return tables.flatMap((table) => table.rows.map((row) => row.values[name])).filter(isThere);
}

function columnsOf(tables, wanted) {
  const columns = new Map();
  for (const table of tables)
    for (const column of table.columns)
      if (wanted(column) && !columns.has(column.name)) columns.set(column.name, column);
  return [...columns.values()];
}

/** @returns {Choice[]} */
export function choicesOf(section) {
  return columnsOf(section.tables, (column) => column.kind === "label" || SIZES.includes(column.name))
    .map(({ name, title }) => ({ name, title, values: [...new Set(cellsOf(section.tables, name).map(String))] }))
    .filter(({ values }) => values.length >= 2 && values.length <= MOST_VALUES);
}

/** 1, 2, 5, 10, ... from at most low to at least high. */
function roundBounds(low, high) {
  const bounds = [];
  for (let decade = 10 ** Math.floor(Math.log10(low)); decade <= high * 10; decade *= 10)
    for (const digit of [1, 2, 5]) bounds.push(digit * decade);
  const first = bounds.findLastIndex((bound) => bound <= low);
  const last = bounds.findIndex((bound) => bound >= high);
  return bounds.slice(first, last + 1);
}

function extentOf(sizes) {
  return sizes.reduce(({ low, high }, size) => ({ low: Math.min(low, size), high: Math.max(high, size) }), {
    low: Infinity,
    high: -Infinity,
  });
}

/** @returns {Range[]} */
export function rangesOf(section) {
  const tables = section.tables.filter((table) => !table.data);
  return columnsOf(tables, (column) => RANGES.includes(column.name))
    .map(({ name, title }) => ({ name, title, ...extentOf(cellsOf(tables, name).filter((size) => size > 0)) }))
    .filter(({ low, high }) => high >= SMALLEST_SPREAD * low)
    .map(({ name, title, low, high }) => ({ name, title, bounds: roundBounds(low, high) }));
}

/** @returns {FilterState} that lets all pass */
export function openFilters() {
  return { without: new Map(), ranges: new Map() };
}

/** @returns {boolean} */
export function passes(state, row, table) {
  for (const [name, values] of state.without) {
    const cell = row.values[name];
    if (isThere(cell) && values.has(String(cell))) return false;
  }
  if (table.data) return true;
  for (const [name, { low, high }] of state.ranges) {
    const cell = row.values[name];
    if (isThere(cell) && (cell < low || cell > high)) return false;
  }
  return true;
}

/** @returns {boolean} whether any row might be held back */
export function isFiltering(state) {
  return state.ranges.size > 0 || [...state.without.values()].some((values) => values.size > 0);
}
