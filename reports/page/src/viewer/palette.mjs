import { interpolateViridis } from "d3-scale-chromatic";

import { REGULAR_DIHEDRAL_ANGLE } from "./tetrahedron_quality.mjs";

// The surface is lighter than the faces of a cut, so that they differ in gray too.
const SURFACE = ["#b4d0f4", "#86cbb4", "#d9c3ec", "#d8d5a0"];
const CUT = ["#e8922c", "#cc553b", "#a8642a", "#b8860b"];

const cycled = (colors, place) => colors[place % colors.length];

/**
 * Colors of the regions, in the order of their numbers.
 * @param {Int32Array} regions
 * @returns {Map<number, {surface: string, cut: string}>}
 */
export function regionColors(regions) {
  const numbers = [...new Set(regions)].sort((a, b) => a - b);
  return new Map(numbers.map((number, place) => [number, { surface: cycled(SURFACE, place), cut: cycled(CUT, place) }]));
}

/**
 * What cells can be colored by: fixed scales, so that meshes can be compared. Good is light and bad is dark.
 * `best` and `worst` are the ends of the scale; beyond, the color stays.
 */
export const MEASURES = {
  r: { title: "measure r", unit: "", best: 1, worst: 3, largestIsWorst: true },
  dihedral: {
    title: "smallest dihedral angle", unit: "°", best: REGULAR_DIHEDRAL_ANGLE, worst: 0, largestIsWorst: false,
  },
};

/** The color ("#rrggbb") of a value of one of the measures. */
export function colorOf(measure, value) {
  const badness = (value - measure.best) / (measure.worst - measure.best);
  return interpolateViridis(1 - Math.min(1, Math.max(0, badness)));
}
