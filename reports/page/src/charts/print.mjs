import config from "../../../charts/config.json" with { type: "json" };

/** How wide a chart is in print, in CSS pixels: a column of a journal, or the text. */
export function printWidth(chart) {
  return chart.spec.usermeta?.columns === 1 ? config.columnWidth : config.textWidth;
}
