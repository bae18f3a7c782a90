import config from "../../../charts/config.json" with { type: "json" };

const PAGE_SCALE = 1.18; // a page is read at a greater distance than paper
const CSS_PIXELS_PER_POINT = 96 / 72;

/**
 * The one size of all text of a chart.
 * @param {import("./themes.mjs").Theme} theme
 * @returns {number} CSS pixels
 */
export function textSize(theme) {
  return config.fontPoints * CSS_PIXELS_PER_POINT * (theme === "page" ? PAGE_SCALE : 1);
}
