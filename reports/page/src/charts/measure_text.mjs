import { textMetrics } from "vega";
import { textWidth } from "./text_width.mjs";

const BOLD = ["bold", "600", "700"];

/** Without a canvas, Vega only guesses how wide text is. */
export function measureWithoutCanvas() {
  textMetrics.width = (item, text) =>
    textWidth(String(text ?? ""), item.fontSize ?? 11, BOLD.includes(String(item.fontWeight)));
}
