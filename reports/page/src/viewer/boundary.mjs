// The faces of a positively oriented cell, each opposite the corner of its number, normals outward.
const FACES = [1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1];

/**
 * Across each face of each cell, the cell on the other side.
 * @param {Uint32Array} cells  four vertices per cell
 * @param {number} vertexCount
 * @returns {Int32Array} four per cell, the face opposite corner i at i; -1: the face is on the boundary
 */
export function neighborsOf(cells, vertexCount) {
  const neighbors = new Int32Array(cells.length).fill(-1);
  // Faces seen once, in lists by their smallest vertex.
  const first = new Int32Array(vertexCount).fill(-1);
  const next = new Int32Array(cells.length);
  const middle = new Uint32Array(cells.length);
  const largest = new Uint32Array(cells.length);
  for (let face = 0; face < cells.length; ++face) {
    const cell = face >> 2, corner = 3 * (face & 3);
    const a = cells[4 * cell + FACES[corner]];
    const b = cells[4 * cell + FACES[corner + 1]];
    const c = cells[4 * cell + FACES[corner + 2]];
    const low = Math.min(a, b, c);
    largest[face] = Math.max(a, b, c);
    middle[face] = a + b + c - low - largest[face];
    let previous = -1;
    let seen = first[low];
    while (seen >= 0 && (middle[seen] !== middle[face] || largest[seen] !== largest[face])) {
      previous = seen;
      seen = next[seen];
    }
    if (seen < 0) {
      next[face] = first[low];
      first[low] = face;
      continue;
    }
    neighbors[face] = seen >> 2;
    neighbors[seen] = cell;
    if (previous < 0) first[low] = next[seen];
    else next[previous] = next[seen];
  }
  return neighbors;
}

/**
 * The boundary of some of the cells: the faces that belong to one of them.
 * @typedef {object} Faces
 * @property {Uint32Array} corners  three vertices per face, counterclockwise from outside
 * @property {Uint32Array} cell     which cell it belongs to, one per face
 * @property {Uint8Array} cut       1: another cell of the mesh is beyond it, one per face
 */

/**
 * @param {Uint32Array} cells
 * @param {Int32Array} neighbors  of neighborsOf
 * @param {Uint8Array} shown       1 if a cell counts, 0 if it does not
 * @returns {Faces}
 */
export function boundaryOf(cells, neighbors, shown) {
  const onBoundary = (face) => shown[face >> 2] && (neighbors[face] < 0 || !shown[neighbors[face]]);
  let count = 0;
  for (let face = 0; face < cells.length; ++face) if (onBoundary(face)) ++count;
  const faces = { corners: new Uint32Array(3 * count), cell: new Uint32Array(count), cut: new Uint8Array(count) };
  let at = 0;
  for (let face = 0; face < cells.length; ++face) {
    if (!onBoundary(face)) continue;
    const cell = face >> 2, corner = 3 * (face & 3);
    for (let i = 0; i < 3; ++i) faces.corners[3 * at + i] = cells[4 * cell + FACES[corner + i]];
    faces.cell[at] = cell;
    faces.cut[at] = neighbors[face] < 0 ? 0 : 1;
    ++at;
  }
  return faces;
}
