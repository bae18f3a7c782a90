/** Pixels of the depth buffer across one unit of the picture. */
const PIXELS = 4;

/**
 * Which faces are seen, the farthest first: drawn in this order, each covers what is behind it. What nothing is seen of
 * in a depth buffer is left out, and so is what looks away.
 * @param {Uint32Array} corners           three vertices a face
 * @param {Float32Array} coordinates      of the vertices: x to the right, y downwards, z toward the observer
 * @param {number} width                  of the picture
 * @param {number} height
 * @returns {number[]}
 */
export function visibleFaces(corners, coordinates, width, height) {
  const columns = Math.ceil(PIXELS * width), rows = Math.ceil(PIXELS * height);
  const depths = new Float32Array(columns * rows).fill(-Infinity);
  const owners = new Int32Array(columns * rows).fill(-1);
  const depthOf = new Float32Array(corners.length / 3);
  for (let face = 0; face < depthOf.length; ++face) {
    const [a, b, c] = [0, 1, 2].map((i) => {
      const at = 3 * corners[3 * face + i];
      return [PIXELS * coordinates[at], PIXELS * coordinates[at + 1], coordinates[at + 2]];
    });
    depthOf[face] = (a[2] + b[2] + c[2]) / 3;
    forEachPixel(a, b, c, columns, rows, (pixel, depth) => {
      if (depth <= depths[pixel]) return;
      depths[pixel] = depth;
      owners[pixel] = face;
    });
  }
  const seen = new Set(owners);
  seen.delete(-1);
  return [...seen].sort((first, second) => depthOf[first] - depthOf[second]);
}

// Visits the pixels whose centers are in a triangle that looks at the observer, with the triangle's depth there.
function forEachPixel(a, b, c, columns, rows, visit) {
  const twiceArea = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (!(twiceArea < 0)) return;
  const left = Math.max(0, Math.floor(Math.min(a[0], b[0], c[0])));
  const right = Math.min(columns - 1, Math.ceil(Math.max(a[0], b[0], c[0])));
  const top = Math.max(0, Math.floor(Math.min(a[1], b[1], c[1])));
  const bottom = Math.min(rows - 1, Math.ceil(Math.max(a[1], b[1], c[1])));
  for (let row = top; row <= bottom; ++row) {
    for (let column = left; column <= right; ++column) {
      const x = column + 0.5, y = row + 0.5;
      const ofA = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / twiceArea;
      const ofB = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / twiceArea;
      const ofC = 1 - ofA - ofB;
      if (ofA >= 0 && ofB >= 0 && ofC >= 0) visit(row * columns + column, ofA * a[2] + ofB * b[2] + ofC * c[2]);
    }
  }
}
