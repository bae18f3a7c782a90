import { deflateSync } from "node:zlib";

const packed = (array) => deflateSync(Buffer.from(array.buffer)).toString("base64");

/**
 * @param {number[][]} points
 * @param {number[][]} cells
 * @param {number[]} [regions]  default: all 0
 * @returns {import("../src/viewer/kept_mesh.mjs").Mesh}
 */
export function meshOf(points, cells, regions = cells.map(() => 0)) {
  return {
    title: "a mesh",
    points: new Float32Array(points.flat()),
    cells: new Uint32Array(cells.flat()),
    regions: new Int32Array(regions),
    numbers: Uint32Array.from(points.keys()),
  };
}

/** The mesh as JSON of schema `ccdt.mesh/1`. */
export function kept(mesh) {
  return {
    schema: "ccdt.mesh/1",
    title: mesh.title,
    vertices: mesh.points.length / 3,
    tetrahedra: mesh.regions.length,
    points: packed(mesh.points),
    cells: packed(mesh.cells),
    regions: packed(mesh.regions),
  };
}

/** Edges of length 2 sqrt(2). */
export const regularTetrahedron = meshOf([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], [[0, 1, 2, 3]]);

/** Two tetrahedra of different regions, one on each side of the triangle (1, 0, 0) (0, 1, 0) (0, 0, 1). */
export const twoTetrahedra =
  meshOf([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], [[0, 1, 2, 3], [4, 1, 3, 2]], [1, 7]);

/** A block of unit cubes, each of six tetrahedra around its diagonal. */
export function block(countX, countY, countZ) {
  const points = [];
  const vertexAt = (x, y, z) => (x * (countY + 1) + y) * (countZ + 1) + z;
  for (let x = 0; x <= countX; ++x) {
    for (let y = 0; y <= countY; ++y) for (let z = 0; z <= countZ; ++z) points.push([x, y, z]);
  }
  const cells = [];
  for (let x = 0; x < countX; ++x) {
    for (let y = 0; y < countY; ++y) {
      for (let z = 0; z < countZ; ++z) cells.push(...cube((dx, dy, dz) => vertexAt(x + dx, y + dy, z + dz)));
    }
  }
  return meshOf(points, cells);
}

// From corner to opposite corner by each order of the three axes; every other order is a mirror image.
function cube(corner) {
  const orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];
  return orders.map((order, i) => {
    const at = [0, 0, 0];
    const path = [corner(...at)];
    for (const axis of order) {
      at[axis] = 1;
      path.push(corner(...at));
    }
    return i < 3 ? path : [path[1], path[0], path[2], path[3]];
  });
}
