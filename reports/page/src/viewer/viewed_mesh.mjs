import { boundaryOf, neighborsOf } from "./boundary.mjs";
import { allCells, centroidsOf, cutAway, extentAlong } from "./cut.mjs";
import { sphereAround } from "./geometry.mjs";
import { unpackMesh } from "./kept_mesh.mjs";
import { MEASURES, regionColors } from "./palette.mjs";
import { sharpEdges } from "./sharp_edges.mjs";
import { qualityOfCells } from "./tetrahedron_quality.mjs";
import { keepOnly, worstFirst } from "./worst_cells.mjs";

/**
 * What is shown of a mesh.
 * @typedef {object} Choice
 * @property {null|{normal: number[], offset: number}} plane  takes away what is beyond it; null: nothing is cut
 * @property {"none"|"r"|"dihedral"} worst                    shows only the worst cells by this measure
 * @property {number} count                                   how many of the worst
 */

/**
 * A mesh with what the viewer needs to know about it. What takes long and is not always asked for is made on demand.
 * @param {object} kept  of schema `ccdt.mesh/1`
 */
export async function viewedMesh(kept) {
  const mesh = await unpackMesh(kept);
  const quality = qualityOfCells(mesh);
  const neighbors = neighborsOf(mesh.cells, kept.vertices);
  const surface = boundaryOf(mesh.cells, neighbors, allCells(mesh.regions.length));
  const values = { r: quality.r, dihedral: quality.smallestDihedral };
  return {
    mesh,
    values,
    neighbors,
    surface,
    centroids: centroidsOf(mesh),
    sphere: sphereAround(mesh.points),
    colors: regionColors(mesh.regions),
    outline: onDemand(() => sharpEdges(mesh.points, surface.corners)),
    worst: {
      r: onDemand(() => worstFirst(values.r, MEASURES.r.largestIsWorst)),
      dihedral: onDemand(() => worstFirst(values.dihedral, MEASURES.dihedral.largestIsWorst)),
    },
  };
}

function onDemand(make) {
  let made;
  return () => (made ??= make());
}

/**
 * @param {Awaited<ReturnType<typeof viewedMesh>>} viewed
 * @param {Choice} choice
 * @returns {{faces: import("./boundary.mjs").Faces, count: number}} the boundary of what is shown, and how many cells are
 */
export function shownPart(viewed, { plane, worst, count }) {
  const shown = allCells(viewed.mesh.regions.length);
  if (plane) cutAway(viewed.centroids, [plane], shown);
  if (worst !== "none") keepOnly(viewed.worst[worst](), count, shown);
  return {
    faces: boundaryOf(viewed.mesh.cells, viewed.neighbors, shown),
    count: shown.reduce((sum, cell) => sum + cell, 0),
  };
}

/** The value of the best among the `count` worst cells; null without cells. */
export function thresholdOf(viewed, measure, count) {
  const order = viewed.worst[measure]();
  return order.length > 0 && count > 0 ? viewed.values[measure][order[Math.min(count, order.length) - 1]] : null;
}

/** The worst value of a measure; null without cells. */
export function worstValue(viewed, measure) {
  const values = viewed.values[measure];
  if (values.length === 0) return null;
  const worse = MEASURES[measure].largestIsWorst ? Math.max : Math.min;
  return values.reduce((worst, value) => worse(worst, value));
}

/** How far the mesh reaches along a direction. */
export const extentOf = (viewed, normal) => extentAlong(viewed.mesh.points, normal);
