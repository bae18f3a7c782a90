import config from "../../../charts/config.json" with { type: "json" };

/** @typedef {"light"|"dark"} Theme */

/** @returns {string} */
export function colourIn(theme, name) {
  return config.palettes[theme][name];
}

/**
 * The configuration of all charts, for Vega-Lite.
 * @param {Theme} theme
 * @param {string} font
 */
export function chartConfig(theme, font = config.font) {
  const { background, text, quiet, axis, grid } = config.themes[theme];
  const named = Object.fromEntries(Object.entries(config.palettes[theme]).map(([name, colour]) => [name, colour]));
  return {
    background,
    font,
    padding: { left: 2, top: 4, right: 6, bottom: 2 },
    view: { stroke: null, continuousWidth: config.columnWidth, continuousHeight: 200 },
    axis: {
      labelColor: quiet, labelFontSize: 10, titleColor: text, titleFontSize: 11, titleFontWeight: "normal",
      titlePadding: 7, domainColor: axis, tickColor: axis, tickSize: 4, gridColor: grid, gridWidth: 0.75,
      labelPadding: 3, labelLimit: 200,
    },
    axisX: { grid: false },
    header: {
      labelColor: text, labelFontSize: 11, labelFontWeight: "bold", labelPadding: 5, title: null, labelLimit: 260,
    },
    legend: {
      orient: "top", direction: "horizontal", title: null, labelColor: text, labelFontSize: 10.5, symbolSize: 60,
      symbolStrokeWidth: 1.6, labelLimit: 260, columnPadding: 14, rowPadding: 3, offset: 8, padding: 0,
    },
    title: { color: text, fontSize: 12, anchor: "start", fontWeight: "bold", offset: 8 },
    point: { filled: true, size: 42, opacity: 1, color: named.blue },
    line: { strokeWidth: 1.6, color: named.blue },
    rule: { strokeWidth: 1.2, color: named.grey },
    tick: { color: named.ink, thickness: 1.6 },
    bar: { color: named.blue },
    text: { color: text, fontSize: 10 },
    mark: { tooltip: { content: "data" } },
    aria: false,
  };
}
