import * as vega from "vega";
import { compile } from "vega-lite";
import { chartData } from "./chart_data.mjs";
import { completeLogAxes } from "./log_axes.mjs";
import { FIRST_ROOM } from "./sizes.mjs";
import { completeSpec } from "./spec.mjs";
import { textSize } from "./text_size.mjs";

/** Charts have their data in them: nothing is ever loaded. */
const loader = {
  load: async (address) => {
    throw new Error(`a chart must not load ${address}`);
  },
  sanitize: async (address) => ({ href: address }),
};

const MOST_FITTINGS = 4;
const CLOSE_ENOUGH = 3; // pixels

/** Keeps what is wrong with a chart instead of writing it to a console. */
function collector(words) {
  const logger = { level: () => logger, error: (...parts) => (words.push(parts.join(" ")), logger) };
  logger.warn = logger.error;
  logger.info = logger.debug = () => logger;
  return logger;
}

const DASHES_SIZE = 620; // square pixels: a line of 25

/**
 * A dashed outline would blur the shapes in a legend: where series have shapes, these alone are shown. Where they are
 * lines alone, these are long enough to show their dashes.
 */
function withClearLegends(spec) {
  for (const legend of spec.legends ?? []) {
    if (legend.shape) delete legend.strokeDash;
    else if (legend.strokeDash) legend.symbolSize = DASHES_SIZE;
  }
  return spec;
}

/**
 * From Vega-Lite to Vega, with clear legends and logarithmic axes.
 * @param {object} spec  of `completeSpec`
 * @param {number} fontSize  pixels
 * @param {object} [logger]
 */
export function compiled(spec, fontSize, logger) {
  const made = withClearLegends(compile(spec, { logger }).spec);
  completeLogAxes(made, fontSize);
  return made;
}

/** @returns {Promise<{view: vega.View, warnings: string[]}>} */
async function run(spec, fontSize) {
  const warnings = [];
  const logger = collector(warnings);
  const runtime = vega.parse(compiled(spec, fontSize, logger));
  const view = new vega.View(runtime, { renderer: "none", loader, logger });
  await view.runAsync();
  return { view, warnings };
}

async function widthOf(view) {
  return Number(/ width="([\d.]+)"/.exec(await view.toSVG())[1]);
}

const MANY_DATA = 2000; // which are not drawn several times, but a part of them

/** The width of the axes and the legend, as far as it is known without drawing all data. */
async function roomOf(section, chart, options, data) {
  const largest = Math.max(...Object.values(data).map((set) => set.length));
  if (largest <= MANY_DATA) return FIRST_ROOM;
  const step = Math.ceil((2 * largest) / MANY_DATA);
  const some = Object.fromEntries(
    Object.entries(data).map(([name, set]) => [name, set.filter((_, index) => set.length <= MANY_DATA || index % step === 0)]),
  );
  const { view, room } = await drawn(section, chart, { ...options, room: undefined, data: some });
  view.finalize();
  return room;
}

/**
 * Draws a chart of a report with the wanted width. The share of the axes is known only after it has been drawn.
 * @param {object} section  of the report
 * @param {object} chart    of the section
 * @param {object} options  of `completeSpec`
 * @param {number} [options.room]  that it took the last time, if it was drawn before: a good guess saves time
 * @returns {Promise<{view: vega.View, warnings: string[], room: number}>}  a view that has run, not yet in a page
 */
export async function drawn(section, chart, options) {
  const data = options.data ?? chartData(section, chart, options.passes);
  let room = options.room ?? (await roomOf(section, chart, options, data));
  for (let fitting = 1; ; ++fitting) {
    const made = await run(completeSpec(section, chart, { ...options, room, data }), textSize(options.theme));
    const excess = (await widthOf(made.view)) - options.width;
    if ((excess <= 0 && excess > -CLOSE_ENOUGH) || fitting === MOST_FITTINGS) return { ...made, room };
    made.view.finalize();
    room += excess + 1;
  }
}
