import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { meshPicture } from "../viewer/mesh_picture.mjs";

/**
 * The kept meshes that are to be drawn, each cut open, as EXPERIMENT-MESH.
 * @param {object} report  of schema `ccdt.report/1`
 * @param {string} folder  in which the report's files are
 * @returns {Promise<{figures: {name: string, svg: string}[], trouble: string[]}>} trouble: what could not be drawn, and why
 */
export async function meshFigures(report, folder) {
  const figures = [], trouble = [];
  for (const { name, meshes } of report.experiments) {
    for (const { file } of meshes.filter(({ figure }) => figure)) {
      try {
        const svg = await meshPicture(JSON.parse(readFileSync(join(folder, file), "utf8")));
        const mesh = basename(file, ".json");
        figures.push({ name: mesh.startsWith(`${name}-`) ? mesh : `${name}-${mesh}`, svg });
      } catch (error) {
        trouble.push(`${file}: ${error.message}`);
      }
    }
  }
  return { figures, trouble };
}
