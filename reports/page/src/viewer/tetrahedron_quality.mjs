/** Degrees, of the regular tetrahedron: no tetrahedron's smallest dihedral angle is larger. */
export const REGULAR_DIHEDRAL_ANGLE = (Math.acos(1 / 3) * 180) / Math.PI;

const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The corners of one cell as four points [x, y, z]. */
export function cornersOf({ points, cells }, cell) {
  return [0, 1, 2, 3].map((i) => {
    const vertex = cells[4 * cell + i];
    return [points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]];
  });
}

/**
 * The paper's measure of shape, ((1/6) sum of the squared edge lengths)^(3/2) / (8.48528 volume): 1 for the regular
 * tetrahedron, and the larger the worse; infinite without volume.
 */
export function measureR([a, b, c, d]) {
  const edges = [subtract(b, a), subtract(c, a), subtract(d, a), subtract(c, b), subtract(d, b), subtract(d, c)];
  const meanSquare = edges.reduce((sum, edge) => sum + dot(edge, edge), 0) / 6;
  const volume = Math.abs(dot(cross(edges[0], edges[1]), edges[2])) / 6;
  return volume > 0 ? meanSquare ** 1.5 / (8.48528 * volume) : Infinity;
}

/** The six dihedral angles in degrees; that of a face without area counts as 0. */
export function dihedralAngles([a, b, c, d]) {
  const ab = subtract(b, a), ac = subtract(c, a), ad = subtract(d, a);
  const faces = [cross(subtract(c, b), subtract(d, b)), cross(ad, ac), cross(ab, ad), cross(ac, ab)];
  const angles = [];
  for (let i = 0; i < 4; ++i) {
    for (let j = i + 1; j < 4; ++j) angles.push(angleBetween(faces[i], faces[j]));
  }
  return angles;
}

// The angle inside, between two faces by their outward normals.
function angleBetween(normal, other) {
  const product = Math.sqrt(dot(normal, normal) * dot(other, other));
  if (!(product > 0)) return 0;
  const cosine = -dot(normal, other) / product;
  return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
}

/**
 * Both measures of every cell.
 * @param {import("./kept_mesh.mjs").Mesh} mesh
 * @returns {{r: Float32Array, smallestDihedral: Float32Array}}
 */
export function qualityOfCells(mesh) {
  const count = mesh.cells.length / 4;
  const r = new Float32Array(count);
  const smallestDihedral = new Float32Array(count);
  for (let cell = 0; cell < count; ++cell) {
    const corners = cornersOf(mesh, cell);
    r[cell] = measureR(corners);
    smallestDihedral[cell] = Math.min(...dihedralAngles(corners));
  }
  return { r, smallestDihedral };
}
