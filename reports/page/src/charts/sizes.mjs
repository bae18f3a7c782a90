import { linesExpression } from "./labels.mjs";
import { textsOf } from "./texts.mjs";

const NARROWEST_CELL = 190;
const NARROWEST_PLOT = 56;
const HIGHEST_OF_MANY = 140; // a plot of several, one above the other
const GAP = 18;
const AXIS = 16; // beside the names of rows

/** The estimated width of the axes and the legend, before a chart has been drawn. */
export const FIRST_ROOM = 58;

function cellsOf({ facet, columns }, data) {
  return textsOf(data, facet.field).length || (Array.isArray(facet.sort) ? facet.sort.length : 0) || columns || 1;
}

function columnsOf(spec, cells, width, room) {
  const narrowest = spec.usermeta?.narrowest ?? NARROWEST_CELL;
  const most = Math.max(1, Math.floor((width - room + GAP) / (narrowest + GAP)));
  return Math.min(spec.columns ?? cells, cells, most);
}

/** The names of cells take several lines where they are wider than a cell. */
function withWrappedHeader(facet, width, fontSize) {
  const label = facet.header?.labelExpr ?? "datum.value";
  return { ...facet, header: { ...facet.header, labelExpr: linesExpression(label, width, fontSize) } };
}

/**
 * A specification that takes about the width, with as many facets side by side as remain legible.
 * @param {object} spec   of Vega-Lite, a single view or facets
 * @param {Object<string, object[]>} data
 * @param {object} size
 * @param {number} size.width  pixels
 * @param {number} size.room   the part of the width outside the plot or the cells of facets
 * @param {number} size.rowLabels  the width of the names of rows, if there are any
 * @param {number} size.fontSize
 */
export function sized(spec, data, { width, room, rowLabels, fontSize }) {
  if (!spec.facet) return { ...spec, width: Math.max(NARROWEST_PLOT, width - room) };
  const cells = cellsOf(spec, data);
  const columns = columnsOf(spec, cells, width, Math.max(FIRST_ROOM, rowLabels + AXIS));
  const cell = Math.floor(Math.max(NARROWEST_PLOT, (width - room - GAP * (columns - 1)) / columns));
  const { height } = spec.spec;
  const isLow = typeof height === "number" && columns < cells;
  return {
    ...spec,
    columns,
    spacing: { row: GAP, column: GAP },
    facet: withWrappedHeader(spec.facet, cell, fontSize),
    spec: { ...spec.spec, width: cell, ...(isLow ? { height: Math.min(height, HIGHEST_OF_MANY) } : {}) },
  };
}
