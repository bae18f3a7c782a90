/** The centroid of each cell, x y z. */
export function centroidsOf({ points, cells }) {
  const count = cells.length / 4;
  const centroids = new Float32Array(3 * count);
  for (let cell = 0; cell < count; ++cell) {
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let i = 0; i < 4; ++i) sum += points[3 * cells[4 * cell + i] + axis];
      centroids[3 * cell + axis] = sum / 4;
    }
  }
  return centroids;
}

/** A mask of cells in which each counts. */
export const allCells = (count) => new Uint8Array(count).fill(1);

/**
 * Takes away the cells whose centroids are beyond all of the planes, so that whole tetrahedra remain.
 * @param {Float32Array} centroids
 * @param {{normal: number[], offset: number}[]} planes  beyond: normal . x > offset. Two planes cut a quarter out.
 * @param {Uint8Array} shown                             changed in place
 */
export function cutAway(centroids, planes, shown) {
  if (planes.length === 0) return;
  for (let cell = 0; cell < shown.length; ++cell) {
    const beyond = ({ normal, offset }) =>
      normal[0] * centroids[3 * cell] + normal[1] * centroids[3 * cell + 1] + normal[2] * centroids[3 * cell + 2] > offset;
    if (planes.every(beyond)) shown[cell] = 0;
  }
}

/**
 * How far the points reach along a direction.
 * @returns {{low: number, high: number}} of normal . x; zero without points
 */
export function extentAlong(points, normal) {
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < points.length; i += 3) {
    const along = normal[0] * points[i] + normal[1] * points[i + 1] + normal[2] * points[i + 2];
    low = Math.min(low, along);
    high = Math.max(high, along);
  }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}
