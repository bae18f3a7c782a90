import { textsOf } from "./texts.mjs";

const NARROWEST_CELL = 190;
const NARROWEST_PLOT = 56;
const GAP = 18;

/** The estimated width of the axes and the legend, before a chart has been drawn. */
export const FIRST_ROOM = 58;

function columnsOf(spec, data, width, room) {
  const { field, sort } = spec.facet;
  const cells = textsOf(data, field).length || (Array.isArray(sort) ? sort.length : 0) || spec.columns || 1;
  const narrowest = spec.usermeta?.narrowest ?? NARROWEST_CELL;
  const most = Math.max(1, Math.floor((width - room + GAP) / (narrowest + GAP)));
  return Math.min(spec.columns ?? cells, cells, most);
}

/**
 * A specification that takes about the width, with as many facets side by side as remain legible.
 * @param {object} spec   of Vega-Lite, a single view or facets
 * @param {Object<string, object[]>} data
 * @param {number} width  pixels
 * @param {number} room   the part of the width outside the plot or the cells of facets
 */
export function sized(spec, data, width, room) {
  if (!spec.facet) return { ...spec, width: Math.max(NARROWEST_PLOT, width - room) };
  const columns = columnsOf(spec, data, width, FIRST_ROOM);
  const cell = Math.max(NARROWEST_PLOT, (width - room - GAP * (columns - 1)) / columns);
  return { ...spec, columns, spacing: { row: GAP, column: GAP }, spec: { ...spec.spec, width: Math.floor(cell) } };
}
