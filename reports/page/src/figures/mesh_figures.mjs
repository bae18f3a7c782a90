import { readFileSync } from "node:fs";
import { join } from "node:path";
import { PRINT_WIDTH } from "../charts/print.mjs";
import { meshPicture } from "../viewer/mesh_picture.mjs";
import { figureNames } from "./figure_name.mjs";

/**
 * The kept meshes that are to be drawn, each cut open, named by what they show.
 * @param {object} report  of schema `ccdt.report/1`
 * @param {string} folder  in which the report's files are
 * @returns {Promise<{figures: {name: string, svg: string}[], trouble: string[]}>} trouble: what could not be drawn, and why
 */
export async function meshFigures(report, folder) {
  const figures = [], trouble = [];
  for (const { name, meshes } of report.experiments) {
    const shown = meshes.filter(({ figure }) => figure);
    const names = figureNames(name, shown.map(({ title }) => title));
    for (const [index, { file }] of shown.entries()) {
      try {
        const kept = JSON.parse(readFileSync(join(folder, file), "utf8"));
        figures.push({ name: names[index], svg: await meshPicture(kept, { size: PRINT_WIDTH }) });
      } catch (error) {
        trouble.push(`${file}: ${error.message}`);
      }
    }
  }
  return { figures, trouble };
}
