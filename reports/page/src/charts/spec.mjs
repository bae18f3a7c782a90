import config from "../../../charts/config.json" with { type: "json" };
import { chartData } from "./chart_data.mjs";
import { inSeriesOrder, seriesStyles } from "./series.mjs";
import { FIRST_ROOM, sized } from "./sizes.mjs";
import { textsOf } from "./texts.mjs";
import { textWidth } from "./text_width.mjs";
import { chartConfig, colorIn, textScale } from "./themes.mjs";

const SERIES_CHANNELS = ["color", "fill", "stroke", "shape", "strokeDash"];
const PLACES = ["x", "y"];
const TABLE_ORDER = ["x", "y", "facet"];
const SERIES_ORDER = ["xOffset", "yOffset"];
const HALF_A_LINE = 6.5;
const LONGEST_LABEL = 0.28; // of the width, in one line
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

/** A text in two lines of about the same width. */
export function inTwoLines(text) {
  const spaces = [...text.matchAll(/ /g)].map(({ index }) => index);
  if (spaces.length === 0) return [text];
  const middle = spaces.reduce((best, at) =>
    Math.abs(at - text.length / 2) < Math.abs(best - text.length / 2) ? at : best,
  );
  return [text.slice(0, middle), text.slice(middle + 1)];
}

/** Long names of rows take two lines where they would leave little room for the rows. */
function wrapLabels(definition, values, theme, width) {
  const long = values.filter((value) => textWidth(value, 10 * textScale(theme)) > LONGEST_LABEL * width);
  if (long.length === 0 || definition.axis === null) return;
  const lines = JSON.stringify(Object.fromEntries(long.map((value) => [value, inTwoLines(value)])));
  const raised = { condition: { test: `isArray(${lines}[datum.value])`, value: -HALF_A_LINE }, value: 0 };
  definition.axis = { ...definition.axis, labelExpr: `${lines}[datum.value] || datum.value`, labelOffset: raised };
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
  const entries = values.map((value) => textWidth(value, 10.5 * textScale(theme)) + room);
  let columns = values.length;
  while (columns > 1 && legendWidth(entries, columns) > width) --columns;
  const rows = Math.ceil(values.length / columns);
  return Math.ceil(values.length / rows);
}

function styleSeries(channel, definition, values, { theme, width, symbol }) {
  const styles = seriesStyles(values);
  const range = styles.map(({ color, shape, dash }) =>
    channel === "shape" ? shape : channel === "strokeDash" ? dash : colorIn(theme, color),
  );
  definition.scale = { domain: values, range };
  if (definition.legend !== null)
    definition.legend = { columns: legendColumns(values, theme, width, symbol), ...definition.legend };
}

// Lines at the powers of ten alone: a logarithmic axis has a tick for each digit.
const POWERS_OF_TEN = {
  condition: { test: "abs(log(datum.value) / LN10 - round(log(datum.value) / LN10)) < 1e-6", value: 1 },
  value: 0,
};

/** A logarithmic axis ends where the data end, with few lines. */
function completeLogarithmic(definition) {
  definition.scale = { nice: false, padding: 10, ...definition.scale };
  if (definition.axis !== null && !definition.axis?.values)
    definition.axis = { gridOpacity: POWERS_OF_TEN, ...definition.axis };
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
  eachChannel(spec, (channel, definition) => {
    if (SERIES_CHANNELS.includes(channel) && typeof definition.datum === "string")
      styleSeries(channel, definition, datumsOf(spec, channel), legend);
    if (definition.scale?.type === "log" && PLACES.includes(channel)) completeLogarithmic(definition);
    if (!isText(definition)) return;
    const named = definition.scale?.range ? undefined : definition.scale?.domain;
    const values = named ?? textsOf(data, definition.field);
    if (values.length === 0) return;
    if (SERIES_CHANNELS.includes(channel) && (named || definition.scale === undefined))
      styleSeries(channel, definition, named ?? inSeriesOrder(values), legend);
    if (channel === "y") wrapLabels(definition, values, theme, width);
    if (definition.sort !== undefined) return;
    if (TABLE_ORDER.includes(channel)) definition.sort = values;
    if (SERIES_ORDER.includes(channel)) definition.sort = inSeriesOrder(values);
  });
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
  { theme = "light", width = config.columnWidth, room = FIRST_ROOM, font, passes, data = chartData(section, chart, passes) } = {},
) {
  const spec = structuredClone(chart.spec);
  completeChannels(spec, data, { theme, width, room });
  return {
    $schema: "https://vega.github.io/schema/vega-lite/v6.json",
    ...sized(spec, data, width, room),
    datasets: data,
    config: chartConfig(theme, font),
  };
}
