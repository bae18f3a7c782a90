import * as vega from "vega";
import { compile } from "vega-lite";
import { FIRST_ROOM } from "./sizes.mjs";
import { completeSpec } from "./spec.mjs";

/** Charts have their data in them: nothing is ever loaded. */
const loader = {
  load: async (address) => { throw new Error(`a chart must not load ${address}`); },
  sanitize: async (address) => ({ href: address }),
};

const MOST_FITTINGS = 3;
const CLOSE_ENOUGH = 3;  // pixels

/** Keeps what is wrong with a chart instead of writing it to a console. */
function collector(words) {
  const logger = { level: () => logger, error: (...parts) => (words.push(parts.join(" ")), logger) };
  logger.warn = logger.error;
  logger.info = logger.debug = () => logger;
  return logger;
}

/** A dashed outline would blur the shapes in a legend: where series have shapes, these alone are shown. */
function withClearLegends(spec) {
  for (const legend of spec.legends ?? []) if (legend.shape) delete legend.strokeDash;
  return spec;
}

/** @returns {Promise<{view: vega.View, warnings: string[]}>} */
async function run(spec, options) {
  const warnings = [];
  const logger = collector(warnings);
  const runtime = vega.parse(withClearLegends(compile(spec, { logger }).spec));
  const view = new vega.View(runtime, { renderer: "none", loader, logger, ...options });
  await view.runAsync();
  return { view, warnings };
}

async function widthOf(view) {
  return Number(/ width="([\d.]+)"/.exec(await view.toSVG())[1]);
}

/**
 * Draws a chart of a report as wide as wanted. How much its axes take of that is known only when it has been drawn.
 * @param {object} section  of the report
 * @param {object} chart    of the section
 * @param {object} options  of `completeSpec`
 * @param {object} viewOptions  of the view: "renderer", "container", "tooltip"
 * @returns {Promise<{view: vega.View, warnings: string[]}>}
 */
export async function drawn(section, chart, options, viewOptions = {}) {
  let room = FIRST_ROOM;
  for (let fitting = 0; fitting < MOST_FITTINGS && chart.spec.facet; ++fitting) {
    const { view } = await run(completeSpec(section, chart, { ...options, room }), {});
    const excess = (await widthOf(view)) - options.width;
    view.finalize();
    if (excess <= 0 && excess > -CLOSE_ENOUGH) break;
    room += excess + 1;
  }
  return run(completeSpec(section, chart, { ...options, room }), viewOptions);
}
