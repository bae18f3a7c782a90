import { expressionFunction } from "vega";
import { textWidth } from "./text_width.mjs";

/** Labels in several lines. A chart may compute its texts, so Vega asks for the lines while it draws. */

const LINE = 1.2; // the height of a line, in sizes of the font
const MOST_LINES = 4;

/** A text in lines that are not wider than the width, which only a single word may be. */
export function inLines(text, width, fontSize) {
  const lines = [];
  for (const word of text.split(" ")) {
    const longer = lines.length > 0 ? `${lines.at(-1)} ${word}` : word;
    if (lines.length > 0 && textWidth(longer, fontSize) <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** The height of so many lines, in pixels. */
export function heightOfLines(count, fontSize) {
  return LINE * fontSize * count;
}

expressionFunction("labelLines", (text, width, fontSize) => inLines(String(text), width, fontSize));

/** An expression of Vega for the lines of a label, itself given as an expression. */
export function linesExpression(text, width, fontSize) {
  return `labelLines(${text}, ${width.toFixed(1)}, ${fontSize.toFixed(3)})`;
}

/** How far labels with several lines are raised, so that their middles are where single lines have theirs. */
export function raisedByLines(width, fontSize) {
  const condition = [];
  for (let count = 2; count <= MOST_LINES; ++count)
    condition.push({
      test: `length(${linesExpression("datum.value", width, fontSize)}) === ${count}`,
      value: -heightOfLines(count - 1, fontSize) / 2,
    });
  return { condition, value: 0 };
}
