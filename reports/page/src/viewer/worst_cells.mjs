/**
 * All cells, the worst first.
 * @param {Float32Array} values     one per cell
 * @param {boolean} largestIsWorst
 * @returns {Uint32Array}
 */
export function worstFirst(values, largestIsWorst) {
  const order = new Uint32Array(values.length).map((_, cell) => cell);
  // Compared, not subtracted: the difference of two infinite values is NaN.
  const ascending = (a, b) => (values[a] < values[b] ? -1 : values[a] > values[b] ? 1 : a - b);
  return order.sort(largestIsWorst ? (a, b) => ascending(b, a) : ascending);
}

/** Keeps of the shown cells only those among the first `count` of the order. */
export function keepOnly(order, count, shown) {
  for (let i = Math.max(0, count); i < order.length; ++i) shown[order[i]] = 0;
}

/**
 * How many of the cells are worse than a threshold.
 * @param {Float32Array} values
 * @param {Uint32Array} order  of worstFirst with the same values
 */
export function countWorseThan(values, order, threshold, largestIsWorst) {
  const isWorse = (cell) => (largestIsWorst ? values[cell] > threshold : values[cell] < threshold);
  let low = 0, high = order.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (isWorse(order[middle])) low = middle + 1;
    else high = middle;
  }
  return low;
}
