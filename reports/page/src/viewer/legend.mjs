import { element } from "../page/dom.mjs";
import { measureText } from "./number_texts.mjs";
import { colourOf, MEASURES } from "./palette.mjs";

/** Colours of the bar between its ends, and numbers below it. */
const STEPS = 16;
const TICKS = 5;

/**
 * What the colours mean.
 * @param {"plain"|"r"|"dihedral"} colouring
 * @param {Map<number, {surface: string, cut: string}>} colours  of the regions
 * @returns {HTMLElement[]}
 */
export function legendOf(colouring, colours) {
  return colouring === "plain" ? plainLegend(colours) : scaleLegend(MEASURES[colouring]);
}

function plainLegend(colours) {
  const several = colours.size > 1;
  return [...colours].flatMap(([region, { surface, cut }]) => [
    swatch(surface, several ? `surface of region ${region}` : "surface"),
    swatch(cut, several ? `inside of region ${region}` : "inside, laid open"),
  ]);
}

function swatch(colour, text) {
  return element("span.viewer-swatch", {}, element("i", { style: `background:${colour}` }), text);
}

function scaleLegend(measure) {
  const valueAt = (share) => measure.best + share * (measure.worst - measure.best);
  const stops = Array.from({ length: STEPS + 1 }, (_, i) => colourOf(measure, valueAt(i / STEPS)));
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
