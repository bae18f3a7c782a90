/** A count, with separators. */
export const countText = (count) => count.toLocaleString("en-US");

/** A number to be read, with three significant digits. */
export function numberText(value) {
  if (value === null) return "none";
  if (!Number.isFinite(value)) return "infinite";
  const magnitude = Math.abs(value);
  const plain = value === 0 || (magnitude >= 1e-3 && magnitude < 1e5);
  return plain ? String(Number(value.toPrecision(3))) : value.toExponential(2);
}

/** A value of a measure with its unit. */
export const measureText = (measure, value) => numberText(value) + (value === null ? "" : measure.unit);
