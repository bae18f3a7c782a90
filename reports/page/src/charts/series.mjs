import config from "../../../charts/config.json" with { type: "json" };

/**
 * How a series looks, the same in all charts: in colour, in grey (by shape and dashes), light and dark.
 * @typedef {{colour: string, shape: string, dash: number[]}} SeriesStyle
 */

function known(value) {
  const name = value.toLowerCase();
  return config.series.find((style) => style.values.includes(name));
}

function rankOf(value) {
  const rank = config.series.findIndex((style) => style.values.includes(value.toLowerCase()));
  return rank < 0 ? config.series.length : rank;
}

/** Our own series first, then the others as the configuration has them, then what it does not know, as it comes. */
export function inSeriesOrder(values) {
  return [...new Set(values)]
    .map((value, position) => ({ value, position }))
    .sort((a, b) => rankOf(a.value) - rankOf(b.value) || a.position - b.position)
    .map(({ value }) => value);
}

/**
 * A style for each series. One that the configuration does not know takes one that no other of them has, as long as
 * there are such.
 * @param {string[]} values  each once
 * @returns {SeriesStyle[]}
 */
export function seriesStyles(values) {
  const taken = new Set();
  const take = (style) => (taken.add(style.colour), { colour: style.colour, shape: style.shape, dash: style.dash });
  const styles = values.map((value) => {
    const style = known(value);
    return style && !taken.has(style.colour) ? take(style) : null;
  });
  let next = 0;
  return styles.map((style) => {
    if (style) return style;
    const spare = config.spareSeries.find(({ colour }) => !taken.has(colour));
    return take(spare ?? config.spareSeries[next++ % config.spareSeries.length]);
  });
}
