import { expressionFunction, scale } from "vega";
import { textWidth } from "./text_width.mjs";

/**
 * Logarithmic axes with few labels, all of them plain numbers: powers of ten, or 1, 2 and 5 times these, or equal steps
 * where there is less than a decade. Which of them depends on the domain and on the room, so Vega asks while it draws.
 */

const NARROW = 4; // the ratio of the ends of a domain below which equal steps are shown
const STEPS = [6, 5, 4, 3, 2]; // how many of them
const MOST_LABELS = 6;
const GAP = 1; // between labels, in sizes of the font

const FORMAT = { maximumSignificantDigits: 6 };

/** A number without exponents or prefixes: 20,000 and 0.001. */
function plainNumber(value) {
  return value.toLocaleString("en-US", FORMAT);
}

/** Multiples of the powers of ten in the domain; every so many decades. */
function multiples([low, high], digits, every = 1) {
  const values = [];
  const slack = 1e-9; // a domain that ends at a power of ten has it, whatever its last bits are
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high) + slack; ++power)
    if (power % every === 0) for (const digit of digits) values.push(Number((digit * 10 ** power).toPrecision(6)));
  return values.filter((value) => value >= low * (1 - slack) && value <= high * (1 + slack));
}

/** What could be labeled, the densest first. */
function candidates(domain) {
  const decades = Math.ceil(Math.log10(domain[1] / domain[0]));
  const equalSteps = STEPS.map((count) => scale("linear")().domain(domain).ticks(count));
  const sparse = Array.from({ length: decades }, (_, index) => multiples(domain, [1], index + 1));
  const decimal = [multiples(domain, [1, 2, 5]), multiples(domain, [1, 3]), ...sparse];
  return (domain[1] / domain[0] < NARROW ? [...equalSteps, ...decimal] : [...decimal, ...equalSteps]).filter(
    (values) => values.length > 0,
  );
}

/** @returns {boolean} whether the labels of all values have room beside each other */
function fits(values, domain, length, isHorizontal, fontSize) {
  const extents = values.map((value) => (isHorizontal ? textWidth(plainNumber(value), fontSize) : fontSize));
  const places = values.map((value) => (length * Math.log(value / domain[0])) / Math.log(domain[1] / domain[0]));
  return values.every(
    (_, index) =>
      index === 0 || places[index] - places[index - 1] >= (extents[index] + extents[index - 1]) / 2 + GAP * fontSize,
  );
}

/**
 * The values to label on a logarithmic axis.
 * @param {number[]} domain  its ends, the lower one first
 * @param {number} length    of the axis, in pixels
 * @param {boolean} isHorizontal
 * @param {number} fontSize  pixels
 */
export function labeledValues(domain, length, isHorizontal, fontSize) {
  if (!(domain[0] > 0) || !(domain[1] > domain[0])) return domain;
  const fitting = candidates(domain).filter(
    (values) => values.length <= MOST_LABELS && fits(values, domain, length, isHorizontal, fontSize),
  );
  return fitting.find((values) => values.length > 1) ?? fitting[0] ?? [];
}

const MOST_DECADES_OF_TICKS = 4;

/** All values with a tick: the labeled ones, and the digits between powers of ten, which show that an axis is logarithmic. */
function tickedValues(domain, labeled) {
  const isLong = domain[1] / domain[0] > 10 ** MOST_DECADES_OF_TICKS;
  const between = isLong || domain[1] / domain[0] < NARROW ? [] : multiples(domain, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
  return [...new Set([...labeled, ...between])].sort((a, b) => a - b);
}

expressionFunction("logTicks", (domain, range, isHorizontal, fontSize) =>
  tickedValues(domain, labeledValues(domain, Math.abs(range[1] - range[0]), isHorizontal, fontSize)),
);
expressionFunction("isLogLabel", (value, domain, range, isHorizontal, fontSize) =>
  labeledValues(domain, Math.abs(range[1] - range[0]), isHorizontal, fontSize).includes(value),
);
expressionFunction("plainNumber", plainNumber);

const isHorizontal = (axis) => axis.orient === "bottom" || axis.orient === "top";

/** An axis whose chart lists its values keeps them. */
function completeAxis(axis, fontSize) {
  const asked = `domain('${axis.scale}'), range('${axis.scale}'), ${isHorizontal(axis)}, ${fontSize}`;
  const isLabel = axis.values ? "true" : `isLogLabel(datum.value, ${asked})`;
  delete axis.tickCount;
  delete axis.format;
  axis.values ??= { signal: `logTicks(${asked})` };
  axis.labelOverlap = false;
  axis.gridOpacity = { signal: `${isLabel} ? 1 : 0` };
  axis.encode = { ...axis.encode, labels: { update: { text: { signal: `${isLabel} ? plainNumber(datum.value) : ''` } } } };
}

/**
 * Completes the logarithmic axes of a specification of Vega, at any depth.
 * @param {object} spec  of Vega, which is changed
 * @param {number} fontSize  pixels
 * @param {Set<string>} logarithmic  the scales around it
 */
export function completeLogAxes(spec, fontSize, logarithmic = new Set()) {
  const known = new Set(logarithmic);
  for (const { name, type } of spec.scales ?? []) type === "log" ? known.add(name) : known.delete(name);
  for (const axis of spec.axes ?? []) if (known.has(axis.scale)) completeAxis(axis, fontSize);
  for (const part of spec.marks ?? []) completeLogAxes(part, fontSize, known);
}
