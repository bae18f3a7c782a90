/** In degrees: if the normals of two faces differ by more, their edge belongs to the outline of the surface. */
const SHARP_ANGLE = 30;

/**
 * The edges of a surface that make its shape: where it turns sharply, or more than two faces meet.
 * @param {Float32Array} points
 * @param {Uint32Array} corners  three vertices per face of a closed surface
 * @returns {Uint32Array} two vertices per edge
 */
export function sharpEdges(points, corners) {
  const normals = normalsOf(points, corners);
  const vertexCount = points.length / 3;
  const smoothest = Math.cos((SHARP_ANGLE * Math.PI) / 180);
  const firstFace = new Map();
  const sharp = new Set();
  for (let i = 0; i < corners.length; ++i) {
    const face = Math.floor(i / 3);
    const a = corners[i], b = corners[i % 3 === 2 ? i - 2 : i + 1];
    const edge = Math.min(a, b) * vertexCount + Math.max(a, b);
    const other = firstFace.get(edge);
    if (other === undefined) firstFace.set(edge, face);
    else if (cosine(normals, face, other) < smoothest) sharp.add(edge);
  }
  return Uint32Array.from([...sharp].flatMap((edge) => [Math.floor(edge / vertexCount), edge % vertexCount]));
}

const cosine = (normals, one, other) => [0, 1, 2].reduce((sum, i) => sum + normals[3 * one + i] * normals[3 * other + i], 0);

function normalsOf(points, corners) {
  const normals = new Float32Array(corners.length);
  for (let at = 0; at < corners.length; at += 3) {
    const [a, b, c] = [3 * corners[at], 3 * corners[at + 1], 3 * corners[at + 2]];
    const u = [0, 1, 2].map((i) => points[b + i] - points[a + i]);
    const v = [0, 1, 2].map((i) => points[c + i] - points[a + i]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal) || 1;
    for (let i = 0; i < 3; ++i) normals[at + i] = normal[i] / length;
  }
  return normals;
}
