import config from "../../../charts/config.json" with { type: "json" };
import { PRINT_WIDTH } from "./print.mjs";
import { textSize } from "./text_size.mjs";

/**
 * Light and dark hold their colors; "page" asks the page's style for them, so that a chart follows its theme.
 * @typedef {"light"|"dark"|"page"} Theme
 */

function fromPage(colors) {
  return Object.fromEntries(Object.keys(colors).map((name) => [name, `var(--chart-${name})`]));
}

function paletteOf(theme) {
  return theme === "page" ? fromPage(config.palettes.light) : config.palettes[theme];
}

function frameOf(theme) {
  return theme === "page" ? { ...fromPage(config.themes.light), background: null } : config.themes[theme];
}

/** @returns {string} */
export function colorIn(theme, name) {
  return paletteOf(theme)[name];
}

/**
 * The configuration of all charts, for Vega-Lite.
 * @param {Theme} theme
 * @param {string} font
 */
export function chartConfig(theme, font = config.font) {
  const { background, text, quiet, axis, grid } = frameOf(theme);
  const named = paletteOf(theme);
  const size = textSize(theme);
  return {
    background,
    font,
    padding: { left: 2, top: 4, right: 6, bottom: 2 },
    view: { stroke: null, continuousWidth: PRINT_WIDTH, continuousHeight: 200 },
    axis: {
      labelColor: quiet,
      labelFontSize: size,
      titleColor: text,
      titleFontSize: size,
      titleFontWeight: "normal",
      titlePadding: 7,
      domainColor: axis,
      tickColor: axis,
      tickSize: 4,
      gridColor: grid,
      gridWidth: 0.75,
      labelPadding: 3,
      labelLimit: 0, // never cut
    },
    axisX: { grid: false },
    header: {
      labelColor: text,
      labelFontSize: size,
      labelFontWeight: "normal",
      labelPadding: 5,
      title: null,
      labelLimit: 0,
    },
    legend: {
      orient: "top",
      direction: "horizontal",
      title: null,
      labelColor: text,
      labelFontSize: size,
      symbolSize: 60,
      symbolStrokeWidth: 1.6,
      labelLimit: 0,
      columnPadding: 14,
      rowPadding: 3,
      offset: 8,
      padding: 0,
    },
    title: { color: text, fontSize: size, anchor: "start", fontWeight: "normal", offset: 8 },
    point: { tooltip: { content: "data" }, filled: true, size: 42, opacity: 1, color: named.blue },
    line: { strokeWidth: 1.6, color: named.blue },
    rule: { tooltip: { content: "data" }, strokeWidth: 1.2, color: named.gray },
    tick: { color: named.ink, thickness: 1.6 },
    bar: { tooltip: { content: "data" }, color: named.blue },
    text: { color: text, fontSize: size },
    aria: false,
  };
}
