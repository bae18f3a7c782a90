import { extentAlong } from "./cut.mjs";

/** Where vertices are, x y z of each. */
export function positionsOf(points, vertices) {
  const positions = new Float32Array(3 * vertices.length);
  for (let i = 0; i < vertices.length; ++i) {
    for (let axis = 0; axis < 3; ++axis) positions[3 * i + axis] = points[3 * vertices[i] + axis];
  }
  return positions;
}

/**
 * The edges of closed, consistently oriented triangles, each once. Every edge occurs equally often in both directions,
 * so one direction is enough.
 * @param {Uint32Array} corners  three vertices per face
 * @returns {Uint32Array} two vertices per edge
 */
export function edgesOf(corners) {
  const edges = [];
  for (let i = 0; i < corners.length; ++i) {
    const from = corners[i], to = corners[i % 3 === 2 ? i - 2 : i + 1];
    if (from < to) edges.push(from, to);
  }
  return new Uint32Array(edges);
}

/** A sphere around all points, by their bounding box. */
export function sphereAround(points) {
  const extents = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => extentAlong(points, axis));
  return {
    center: extents.map(({ low, high }) => (low + high) / 2),
    radius: Math.hypot(...extents.map(({ low, high }) => (high - low) / 2)) || 1,
  };
}
