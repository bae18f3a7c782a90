/**
 * A mesh as the viewer works on it.
 * @typedef {object} Mesh
 * @property {string} title
 * @property {Float32Array} points  x y z of each vertex
 * @property {Uint32Array} cells    four vertices of each tetrahedron, positively oriented
 * @property {Int32Array} regions   one a tetrahedron
 */

/**
 * Unpacks a mesh of schema `ccdt.mesh/1`, in a browser as in node.
 * @param {object} kept  the parsed JSON
 * @returns {Promise<Mesh>}
 * @throws {Error} when the arrays do not make a mesh
 */
export async function unpackMesh(kept) {
  const [points, cells, regions] = await Promise.all([kept.points, kept.cells, kept.regions].map(inflated));
  const mesh = {
    title: kept.title,
    points: new Float32Array(points),
    cells: new Uint32Array(cells),
    regions: new Int32Array(regions),
  };
  expectConsistent(mesh, kept);
  return mesh;
}

async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function expectConsistent(mesh, kept) {
  if (mesh.points.length !== 3 * kept.vertices) throw new Error("The mesh has another number of vertices than it says.");
  if (mesh.cells.length !== 4 * kept.tetrahedra || mesh.regions.length !== kept.tetrahedra) {
    throw new Error("The mesh has another number of tetrahedra than it says.");
  }
  for (const vertex of mesh.cells) {
    if (vertex >= kept.vertices) throw new Error("A tetrahedron of the mesh has a vertex that is not there.");
  }
}
