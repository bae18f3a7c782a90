import { element } from "../page/dom.mjs";
import { measureText } from "./number_texts.mjs";
import { colorOf, MEASURES } from "./palette.mjs";

/** Colors of the bar between its ends, and numbers below it. */
const STEPS = 16;
const TICKS = 5;

/**
 * What the colors mean.
 * @param {"plain"|"r"|"dihedral"} coloring
 * @param {Map<number, {surface: string, cut: string}>} colors  of the regions
 * @returns {HTMLElement[]}
 */
export function legendOf(coloring, colors) {
  return coloring === "plain" ? plainLegend(colors) : scaleLegend(MEASURES[coloring]);
}

function plainLegend(colors) {
  const several = colors.size > 1;
  return [...colors].flatMap(([region, { surface, cut }]) => [
    swatch(surface, several ? `surface of region ${region}` : "surface"),
    swatch(cut, several ? `inside of region ${region}` : "inside, cut open"),
  ]);
}

function swatch(color, text) {
  return element("span.viewer-swatch", {}, element("i", { style: `background:${color}` }), text);
}

function scaleLegend(measure) {
  const valueAt = (share) => measure.best + share * (measure.worst - measure.best);
  const stops = Array.from({ length: STEPS + 1 }, (_, i) => colorOf(measure, valueAt(i / STEPS)));
  const ticks = Array.from({ length: TICKS }, (_, i) => {
    const beyond = i === TICKS - 1 && measure.largestIsWorst ? " and more" : "";
    return element("span", {}, measureText(measure, valueAt(i / (TICKS - 1))) + beyond);
  });
  return [
    element("span", {}, `${measure.title}: good to bad`),
    element("span.viewer-scale", {},
      element("i", { style: `background:linear-gradient(to right, ${stops.join(", ")})` }),
      element("span.viewer-ticks", {}, ticks)),
  ];
}
