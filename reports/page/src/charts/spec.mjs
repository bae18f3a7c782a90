import { chartData } from "./chart_data.mjs";
import { heightOfLines, inLines, linesExpression, raisedByLines } from "./labels.mjs";
import { PRINT_WIDTH } from "./print.mjs";
import { inSeriesOrder, seriesStyles } from "./series.mjs";
import { FIRST_ROOM, sized } from "./sizes.mjs";
import { textSize } from "./text_size.mjs";
import { textsOf } from "./texts.mjs";
import { textWidth } from "./text_width.mjs";
import { chartConfig, colorIn } from "./themes.mjs";

const SERIES_CHANNELS = ["color", "fill", "stroke", "shape", "strokeDash"];
const PLACES = ["x", "y"];
const TABLE_ORDER = ["x", "y", "facet"];
const SERIES_ORDER = ["xOffset", "yOffset"];
const LONGEST_LABEL = 0.48; // of the width, in one line
const ROW_GAP = 5; // pixels between the labels of rows
const SYMBOL_ROOM = 30; // of a legend's entry, beside its text
const LINE_ROOM = 48; // the same of a line that shows its dashes

/** Calls a function for each definition of a channel, at any depth. */
function eachChannel(spec, visit) {
  for (const [channel, definition] of Object.entries(spec.encoding ?? {}))
    if (definition && !Array.isArray(definition)) visit(channel, definition);
  if (spec.facet?.field) visit("facet", spec.facet);
  for (const part of [spec.spec, ...(spec.layer ?? []), ...(spec.hconcat ?? []), ...(spec.vconcat ?? [])])
    if (part) eachChannel(part, visit);
}

function isText(definition) {
  return definition.field !== undefined && ["nominal", "ordinal"].includes(definition.type);
}

/** Makes rows at least this high, unless each has several marks beside each other. */
function raiseRows(spec, height) {
  const isNested = spec.encoding?.yOffset !== undefined;
  if (spec.height?.step && !isNested) spec.height.step = Math.max(spec.height.step, height);
  if (spec.spec) raiseRows(spec.spec, height);
}

/** Names of rows take several lines where they would leave little room for the rows, which then are higher. */
function wrapRowLabels(spec, definition, values, { theme, width }) {
  if (definition.axis === null) return;
  const fontSize = textSize(theme);
  const widest = LONGEST_LABEL * width;
  definition.axis = {
    ...definition.axis,
    labelExpr: linesExpression("datum.value", widest, fontSize),
    labelOffset: raisedByLines(widest, fontSize),
    labelLineHeight: heightOfLines(1, fontSize),
  };
  const most = Math.max(1, ...values.map((value) => inLines(value, widest, fontSize).length));
  raiseRows(spec, heightOfLines(most, fontSize) + ROW_GAP);
}

/** The width of a legend with its entries in this many columns, row by row. */
function legendWidth(entries, columns) {
  let width = 0;
  for (let column = 0; column < columns; ++column)
    width += Math.max(...entries.filter((_, index) => index % columns === column));
  return width;
}

/** The number of columns of a legend that has as few rows as possible, all about equally full. */
function legendColumns(values, theme, width, room) {
  const entries = values.map((value) => Math.min(width, textWidth(value, textSize(theme)) + room));
  let columns = values.length;
  while (columns > 1 && legendWidth(entries, columns) > width) --columns;
  const rows = Math.ceil(values.length / columns);
  return Math.ceil(values.length / rows);
}

/** A legend with as many columns as it has room for, and no cut labels. */
function completeLegend(definition, values, { theme, width, symbol }) {
  if (definition.legend === null) return;
  const label = definition.legend?.labelExpr ?? "datum.label";
  definition.legend = {
    columns: legendColumns(values, theme, width, symbol),
    ...definition.legend,
    labelExpr: linesExpression(label, width - symbol, textSize(theme)),
  };
}

function styleSeries(channel, definition, values, theme) {
  const styles = seriesStyles(values);
  const range = styles.map(({ color, shape, dash }) =>
    channel === "shape" ? shape : channel === "strokeDash" ? dash : colorIn(theme, color),
  );
  definition.scale = { domain: values, range };
}

/** The places of which the chart says where they start. Its layers share them, and only one of them need say so. */
function placesWithStart(spec) {
  const places = new Set();
  eachChannel(spec, (channel, { scale }) => {
    if (scale?.type === "log" || scale?.domain) places.add(channel);
  });
  return places;
}

/** A logarithmic axis ends where the data end; a linear one starts at zero, unless the chart says where. */
function completePlace(definition, hasStart) {
  const { scale } = definition;
  if (scale?.type === "log") definition.scale = { nice: false, padding: 10, ...scale };
  else if (definition.type === "quantitative" && !hasStart)
    definition.scale = { zero: true, domainMin: 0, nice: true, ...scale };
}

/** The width of the names of rows, or the most that it can be where the chart computes them. */
function rowLabelWidth(spec, data, theme, width) {
  const fontSize = textSize(theme);
  let widest = 0;
  eachChannel(spec, (channel, definition) => {
    if (channel !== "y" || !isText(definition) || definition.axis === null) return;
    const lines = textsOf(data, definition.field).flatMap((value) => inLines(value, LONGEST_LABEL * width, fontSize));
    const widths = lines.map((line) => textWidth(line, fontSize));
    widest = Math.max(widest, ...(widths.length > 0 ? widths : [LONGEST_LABEL * width]));
  });
  return widest;
}

/** The width of the symbol in a legend's entry: longer if the series are only lines. */
function symbolRoom(spec) {
  const channels = new Set();
  eachChannel(spec, (channel) => channels.add(channel));
  return channels.has("strokeDash") && !channels.has("shape") ? LINE_ROOM : SYMBOL_ROOM;
}

/** What the layers of a chart say of themselves: {"color": {"datum": "the paper"}}. */
function datumsOf(spec, channel) {
  const datums = [];
  eachChannel(spec, (name, definition) => {
    if (name === channel && typeof definition.datum === "string") datums.push(definition.datum);
  });
  return [...new Set(datums)];
}

/**
 * What a chart leaves to us: series look as in the configuration, texts come in the order of the tables.
 * A channel with a scale or an order of its own keeps it. A scale with only a domain names series that are not texts of
 * the tables.
 */
function completeChannels(spec, data, { theme, width, room }) {
  const legend = { theme, width: width - room, symbol: symbolRoom(spec) };
  const withStart = placesWithStart(spec);
  const complete = (channel, definition, values) => {
    if (definition.scale === undefined || (definition.scale.domain && !definition.scale.scheme))
      styleSeries(channel, definition, values, theme);
    completeLegend(definition, values, legend);
  };
  eachChannel(spec, (channel, definition) => {
    const isSeries = SERIES_CHANNELS.includes(channel);
    if (isSeries && typeof definition.datum === "string") complete(channel, definition, datumsOf(spec, channel));
    if (PLACES.includes(channel)) completePlace(definition, withStart.has(channel));
    if (!isText(definition)) return;
    const values = textsOf(data, definition.field);
    if (channel === "y") wrapRowLabels(spec, definition, values, { theme, width });
    const named = definition.scale?.domain ?? inSeriesOrder(values);
    if (isSeries && named.length > 0 && !definition.scale?.range) complete(channel, definition, named);
    if (definition.sort !== undefined || values.length === 0) return;
    if (TABLE_ORDER.includes(channel)) definition.sort = values;
    if (SERIES_ORDER.includes(channel)) definition.sort = inSeriesOrder(values);
  });
}

/** Titles of axes take several lines where they are longer than their axes. */
function wrapTitles(spec, fontSize) {
  const { width, height } = spec.spec ?? spec;
  const lengths = { x: width, y: height };
  eachChannel(spec, (channel, definition) => {
    const length = lengths[channel];
    if (typeof definition.title === "string" && typeof length === "number")
      definition.title = inLines(definition.title, length, fontSize);
  });
  return spec;
}

/**
 * From a chart of a report to Vega-Lite with data.
 * @param {object} section  of the report
 * @param {object} chart    one of the section's charts
 * @param {object} options
 * @param {import("./themes.mjs").Theme} options.theme
 * @param {number} options.width  pixels that the whole chart may take
 * @param {number} [options.room]  the part of the width outside the plot or the cells of facets
 * @param {string} [options.font]
 * @param {(row: object, table: object) => boolean} [options.passes]  a filter of the rows
 * @param {Object<string, object[]>} [options.data]  of `chartData`, if it is known already
 * @returns {object} a specification of Vega-Lite
 */
export function completeSpec(
  section,
  chart,
  { theme = "light", width = PRINT_WIDTH, room = FIRST_ROOM, font, passes, data = chartData(section, chart, passes) } = {},
) {
  const spec = structuredClone(chart.spec);
  const fontSize = textSize(theme);
  completeChannels(spec, data, { theme, width, room });
  const size = { width, room, fontSize, rowLabels: rowLabelWidth(spec, data, theme, width) };
  return {
    $schema: "https://vega.github.io/schema/vega-lite/v6.json",
    ...wrapTitles(sized(spec, data, size), fontSize),
    datasets: data,
    config: chartConfig(theme, font),
  };
}
