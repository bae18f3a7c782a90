import { drawn } from "../charts/draw.mjs";
import { measureWithoutCanvas } from "../charts/measure_text.mjs";
import { PRINT_WIDTH } from "../charts/print.mjs";

measureWithoutCanvas();

/** The SVG has the title and the caption for readers who cannot see it. */
function described(svg, chart) {
  const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
  const words = `<title>${escaped(chart.title)}</title><desc>${escaped(chart.caption)}</desc>`;
  return svg.replace(/(<svg[^>]*>)/, (tag) => tag.replace("<svg", '<svg role="img"') + words) + "\n";
}

/**
 * A chart for print: light, and as wide as a column of a journal.
 * @returns {Promise<string>} SVG
 */
export async function chartSvg(section, chart) {
  const { view, warnings } = await drawn(section, chart, { theme: "light", width: PRINT_WIDTH });
  for (const words of warnings) console.error(`${section.name}, ${chart.name}: ${words}`);
  const svg = await view.toSVG();
  view.finalize();
  return described(svg, chart);
}
