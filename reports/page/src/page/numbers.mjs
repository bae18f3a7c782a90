/** How numbers and cells of tables are written. */

const NOTHING = "–";
const SIGNIFICANT = 4;
const MOST_DECIMALS = 6;

function magnitude(number) {
  return number === 0 ? 0 : Math.floor(Math.log10(Math.abs(number)));
}

// By the number of decimals. Making a format takes longer than using it a thousand times.
const formats = new Map();

function formatOf(decimals) {
  if (!formats.has(decimals))
    formats.set(
      decimals,
      new Intl.NumberFormat("en-US", { minimumFractionDigits: decimals, maximumFractionDigits: decimals }),
    );
  return formats.get(decimals);
}

function grouped(number, decimals) {
  const rounded = Number(number.toFixed(decimals)) || 0; // never -0
  return formatOf(decimals).format(rounded);
}

function scientific(number) {
  const [digits, exponent] = number.toExponential(2).split("e");
  const raised = String(Number(exponent)).replace(/[-0-9]/g, (sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]);
  return `${digits}×10${raised}`;
}

/**
 * @param {number|null|undefined} number
 * @param {number} [decimals]  default: none for whole numbers, otherwise as many as four significant digits need
 */
export function numberText(number, decimals) {
  if (number === null || number === undefined || !Number.isFinite(number)) return NOTHING;
  if (number !== 0 && (Math.abs(number) < 1e-4 || Math.abs(number) >= 1e15)) return scientific(number);
  if (decimals !== undefined) return grouped(number, decimals);
  if (Number.isInteger(number)) return grouped(number, 0);
  return grouped(number, Math.min(MOST_DECIMALS, Math.max(0, SIGNIFICANT - 1 - magnitude(number))));
}

/** @returns {boolean} */
export function isEstimate(cell) {
  return typeof cell === "object" && cell !== null;
}

/** The number of decimals that show two digits of the interval. */
function estimateDecimals({ value, low, high }) {
  const width = high - low;
  if (!(width > 0)) return Math.max(0, SIGNIFICANT - 1 - magnitude(value));
  const byWidth = 1 - magnitude(width);
  const bySize = SIGNIFICANT + 1 - magnitude(value);
  return Math.min(MOST_DECIMALS, Math.max(0, Math.min(byWidth, bySize)));
}

/**
 * An estimate in two parts.
 * @returns {{value: string, interval: string}}  the interval is empty if there is none, or if it has no width
 */
export function estimateTexts(estimate) {
  const decimals = estimateDecimals(estimate);
  const { value, low, high } = estimate;
  const interval = high > low ? `[${numberText(low, decimals)}, ${numberText(high, decimals)}]` : "";
  return { value: numberText(value, decimals), interval };
}

/**
 * Any cell as one text.
 * @param {null|string|number|{value: number, low: number, high: number}} cell
 * @param {number} [decimals]
 */
export function cellText(cell, decimals) {
  if (cell === null || cell === undefined || cell === "") return NOTHING;
  if (typeof cell === "string") return cell;
  if (typeof cell === "number") return numberText(cell, decimals);
  const { value, interval } = estimateTexts(cell);
  return interval ? `${value} ${interval}` : value;
}

/**
 * The number of decimals for all numbers of a column, so that they can be compared by eye.
 * @returns {number|undefined}  undefined: they differ too much in size to have the same number
 */
export function commonDecimals(cells) {
  const numbers = cells.filter((cell) => typeof cell === "number" && Number.isFinite(cell));
  if (numbers.every(Number.isInteger)) return 0;
  const sizes = numbers.filter((number) => number !== 0).map(magnitude);
  const smallest = Math.min(...sizes),
    largest = Math.max(...sizes);
  if (largest - smallest > 4) return undefined;
  return Math.min(MOST_DECIMALS, Math.max(0, SIGNIFICANT - 1 - largest, 1 - smallest));
}

/** What a cell is sorted by: a number, a text, or null, which comes last. */
export function sortKey(cell) {
  if (cell === "" || cell === undefined) return null;
  return isEstimate(cell) ? cell.value : cell;
}

/** @returns {string} "1 run", "3 runs" */
export function counted(count, noun) {
  return `${numberText(count)} ${noun}${count === 1 ? "" : "s"}`;
}
