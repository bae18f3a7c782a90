import config from "../../../charts/config.json" with { type: "json" };

/**
 * How a series looks, the same in all charts: in color, in gray (by shape and dashes), light and dark.
 * @typedef {{color: string, shape: string, dash: number[]}} SeriesStyle
 */

/** The position of a name, or of its beginning, in the configuration; an unknown name is last. */
function rankOf(value) {
  const name = value.toLowerCase();
  const exact = config.series.findIndex(({ values }) => values?.includes(name));
  const start = config.series.findIndex(({ starts }) => starts?.some((word) => name.startsWith(word)));
  return exact >= 0 ? exact : start >= 0 ? start : config.series.length;
}

/** Series in the order of the configuration, our own first; unknown ones come last, in their given order. */
export function inSeriesOrder(values) {
  return [...new Set(values)]
    .map((value, position) => ({ value, position }))
    .sort((a, b) => rankOf(a.value) - rankOf(b.value) || a.position - b.position)
    .map(({ value }) => value);
}

/**
 * A style for each series. A series that the configuration does not know takes a style that no other has, as long as
 * there is one.
 * @param {string[]} values  each once
 * @returns {SeriesStyle[]}
 */
export function seriesStyles(values) {
  const taken = new Set();
  const take = (style) => (taken.add(style.color), { color: style.color, shape: style.shape, dash: style.dash });
  const styles = values.map((value) => {
    const style = config.series[rankOf(value)];
    return style && !taken.has(style.color) ? take(style) : null;
  });
  let next = 0;
  return styles.map((style) => {
    if (style) return style;
    const spare = config.spareSeries.find(({ color }) => !taken.has(color));
    return take(spare ?? config.spareSeries[next++ % config.spareSeries.length]);
  });
}
