/**
 * Meshes of schema `ccdt.pagemesh/1`: bench/results/compact_mesh.cpp says how they are written down, step by step.
 */
import { inflated } from "./inflated.mjs";

const PLACES = 4; // bytes of a difference
const NO_RANK = 255;
const STEPS_A_BYTE = 5;
const NEW_VERTEX = 1;
const KNOWN_VERTEX = 2;

// The faces of a positively oriented cell, each opposite the corner of its number, normals outward.
const FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

const bytesOf = async (base64) => new Uint8Array(await inflated(base64));

/** @returns {Promise<import("./kept_mesh.mjs").Mesh>} */
export async function unpackCompactMesh(kept) {
  const [x, y, z, numbers, regions] = await Promise.all(
    [...kept.coordinates, kept.numbers, kept.regions].map(async (array) => sumsOf(await bytesOf(array))),
  );
  const points = new Float32Array(3 * kept.vertices);
  [x, y, z].forEach((places, axis) => {
    for (let i = 0; i < kept.vertices; ++i) points[3 * i + axis] = kept.low[axis] + kept.step * places[i];
  });
  const cells = walkedCells(await bytesOf(kept.steps), await bytesOf(kept.codes), kept);
  return { title: kept.title, points, cells, regions: Int32Array.from(regions), numbers: Uint32Array.from(numbers) };
}

/** Decodes numbers stored as differences, with the sign in the lowest bit and all bytes of one place together. */
function sumsOf(bytes) {
  const count = bytes.length / PLACES;
  const numbers = new Float64Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    let code = 0;
    for (let place = PLACES - 1; place >= 0; --place) code = 256 * code + bytes[place * count + i];
    sum += code % 2 === 1 ? -(code + 1) / 2 : code / 2;
    numbers[i] = sum;
  }
  return numbers;
}

/** Which vertices are joined by an edge so far. */
function edgesOf(vertexCount) {
  const joined = Array.from({ length: vertexCount }, () => []);
  const corners = new Uint8Array(vertexCount);
  const join = (a, b) => {
    if (joined[a].includes(b)) return;
    joined[a].push(b);
    joined[b].push(a);
  };
  return {
    joinAll(a, b, c, d) {
      join(a, b), join(a, c), join(a, d), join(b, c), join(b, d), join(c, d);
    },
    /** The vertex of a rank among those joined to corners of a face: first those joined to more corners, then later ones. */
    ofRank(rank, face, apex) {
      const candidates = [];
      for (const corner of face) for (const v of joined[corner]) if (corners[v]++ === 0) candidates.push(v);
      const ranked = candidates.filter((v) => v !== apex && !face.includes(v));
      ranked.sort((a, b) => corners[b] - corners[a] || b - a);
      for (const v of candidates) corners[v] = 0;
      return ranked[rank];
    },
  };
}

/** Repeats the walk over the mesh in which it was written. */
function walkedCells(stepBytes, codes, { vertices, tetrahedra }) {
  const cells = new Uint32Array(4 * tetrahedra);
  const isSeed = new Uint8Array(tetrahedra);
  const edges = edgesOf(vertices);
  let metCells = 0, metVertices = 0, nextStep = 0, nextCode = 0;
  const readStep = () => {
    const at = nextStep++;
    return Math.floor(stepBytes[Math.floor(at / STEPS_A_BYTE)] / 3 ** (at % STEPS_A_BYTE)) % 3;
  };
  const readNumber = () => {
    nextCode += 3;
    return codes[nextCode - 3] + 256 * codes[nextCode - 2] + 65536 * codes[nextCode - 1];
  };
  const meet = (corners) => {
    cells.set(corners, 4 * metCells++);
    edges.joinAll(...corners);
  };
  for (let cell = 0; cell < tetrahedra; ++cell) {
    if (cell === metCells) {
      isSeed[cell] = 1;
      const corners = [readNumber(), readNumber(), readNumber(), readNumber()];
      metVertices = Math.max(metVertices, ...corners.map((vertex) => vertex + 1));
      meet(corners);
    }
    const corners = cells.subarray(4 * cell, 4 * cell + 4);
    for (let i = 0; i < (isSeed[cell] ? 4 : 3); ++i) {
      const step = readStep();
      if (step !== NEW_VERTEX && step !== KNOWN_VERTEX) continue;
      const face = FACES[i].map((corner) => corners[corner]);
      if (step === NEW_VERTEX) meet([...face, metVertices++]);
      else {
        const rank = codes[nextCode++];
        meet([...face, rank === NO_RANK ? readNumber() : edges.ofRank(rank, face, corners[i])]);
      }
    }
  }
  return cells;
}
