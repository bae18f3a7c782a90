/**
 * Draws the figures of a report: node render_figures.mjs REPORT.json OUT
 *
 * Each chart becomes OUT/EXPERIMENT-CHART.svg, and .pdf and .png of it; each mesh that was kept for a picture becomes
 * OUT/EXPERIMENT-TITLE.svg, .pdf and .png: fig7-piston.pdf. Meshes are read from the folder of REPORT.json.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { chartSvg } from "./chart_svg.mjs";
import { convertAll } from "./convert.mjs";
import { meshFigures } from "./mesh_figures.mjs";

/** @returns {Promise<{name: string, svg: string}[]>} */
async function chartFigures(report) {
  const figures = [];
  for (const section of report.experiments)
    for (const chart of section.charts)
      figures.push({ name: `${section.name}-${chart.name}`, svg: await chartSvg(section, chart) });
  return figures;
}

async function main(reportFile, folder) {
  const report = JSON.parse(readFileSync(reportFile, "utf8"));
  const meshes = await meshFigures(report, dirname(reportFile));
  for (const words of meshes.trouble) console.error(`No picture of ${words}`);
  const figures = [...(await chartFigures(report)), ...meshes.figures];
  mkdirSync(folder, { recursive: true });
  for (const { name, svg } of figures) writeFileSync(join(folder, `${name}.svg`), svg);
  const trouble = await convertAll(folder, figures.map(({ name }) => name));
  if (trouble) console.error(trouble);
}

const [reportFile, folder] = process.argv.slice(2);
if (!reportFile || !folder) {
  console.error("usage: node render_figures.mjs REPORT.json OUT");
  process.exit(2);
}
await main(reportFile, folder);
