import { unpackCompactMesh } from "./compact_mesh.mjs";
import { inflated } from "./inflated.mjs";

/**
 * A mesh as the viewer works on it.
 * @typedef {object} Mesh
 * @property {string} title
 * @property {Float32Array} points  x y z of each vertex
 * @property {Uint32Array} cells    four vertices of each tetrahedron, positively oriented
 * @property {Int32Array} regions   one per tetrahedron
 * @property {Uint32Array} numbers  of the vertices, in the file of the mesh
 */

/**
 * Unpacks a mesh of schema `ccdt.mesh/1` or `ccdt.pagemesh/1`, in a browser or in node.
 * @param {object} kept  the parsed JSON
 * @returns {Promise<Mesh>}
 * @throws {Error} when the arrays do not make a mesh
 */
export async function unpackMesh(kept) {
  const mesh = kept.schema === "ccdt.pagemesh/1" ? await unpackCompactMesh(kept) : await unpackPlainMesh(kept);
  expectConsistent(mesh, kept);
  return mesh;
}

async function unpackPlainMesh(kept) {
  const [points, cells, regions] = await Promise.all([kept.points, kept.cells, kept.regions].map(inflated));
  return {
    title: kept.title,
    points: new Float32Array(points),
    cells: new Uint32Array(cells),
    regions: new Int32Array(regions),
    numbers: Uint32Array.from({ length: kept.vertices }, (_, vertex) => vertex),
  };
}

function expectConsistent(mesh, kept) {
  if (mesh.points.length !== 3 * kept.vertices) throw new Error("The number of vertices differs from the stated one.");
  if (mesh.cells.length !== 4 * kept.tetrahedra || mesh.regions.length !== kept.tetrahedra) {
    throw new Error("The number of tetrahedra differs from the stated one.");
  }
  for (const vertex of mesh.cells) {
    if (vertex >= kept.vertices) throw new Error("A tetrahedron of the mesh has a vertex that does not exist.");
  }
}
