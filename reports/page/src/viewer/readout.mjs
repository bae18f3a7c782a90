import { element } from "../page/dom.mjs";
import { countText, measureText, numberText } from "./number_texts.mjs";
import { MEASURES } from "./palette.mjs";
import { cornersOf, dihedralAngles, measureR } from "./tetrahedron_quality.mjs";
import { worstValue } from "./viewed_mesh.mjs";

/** The numbers of a mesh and of what is shown of it. */
export function readoutOf(viewed, shownCount) {
  const { mesh } = viewed;
  return facts([
    ["vertices", countText(mesh.points.length / 3)],
    ["tetrahedra", countText(mesh.regions.length)],
    ["worst r", measureText(MEASURES.r, worstValue(viewed, "r"))],
    ["smallest dihedral angle", measureText(MEASURES.dihedral, worstValue(viewed, "dihedral"))],
    ["shown", `${countText(shownCount)} tetrahedra`],
  ]);
}

/** What there is to know about one tetrahedron. */
export function tetrahedronFacts(viewed, cell) {
  const { mesh } = viewed;
  const corners = cornersOf(mesh, cell);
  const angles = dihedralAngles(corners).sort((a, b) => a - b);
  const vertices = corners.map((point, i) => `${mesh.numbers[mesh.cells[4 * cell + i]]} (${point.map(numberText).join(", ")})`);
  return [
    element("strong", {}, "Tetrahedron"),
    facts([
      ["r", numberText(measureR(corners))],
      ["dihedral angles", `${angles.map((angle) => angle.toFixed(1)).join(", ")}°`],
      ["region", String(mesh.regions[cell])],
      ["vertices", vertices.join("; ")],
    ]),
  ];
}

const facts = (pairs) =>
  element("dl", {}, pairs.map(([name, text]) => element("div", {}, element("dt", {}, name), element("dd", {}, text))));
