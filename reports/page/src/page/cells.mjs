import { element } from "./dom.mjs";
import { cellText, estimateTexts, isEstimate } from "./numbers.mjs";

/** What a cell shows: an estimate's interval is less prominent than its value. */
export function cellContent(cell, decimals) {
  if (!isEstimate(cell)) return cellText(cell, decimals);
  const { value, interval } = estimateTexts(cell);
  return [value, interval ? element("span.interval", {}, ` ${interval}`) : null];
}
