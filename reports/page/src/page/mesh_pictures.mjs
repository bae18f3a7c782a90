import { figureNames } from "../figures/figure_name.mjs";
import { meshPicture } from "../viewer/mesh_picture.mjs";
import { element } from "./dom.mjs";
import { download } from "./downloads.mjs";
import { inTurn } from "./in_turn.mjs";

/** One mesh, cut open. */
function picture({ file, title }, name, kept) {
  const image = element("img", { alt: `${title}, cut open` });
  const save = element(
    "button.small",
    { type: "button", hidden: true, "aria-label": `Download the picture of ${title} as SVG` },
    "SVG",
  );
  const caption = element("figcaption", {}, `${title} `, save);
  const figure = element("figure.mesh-picture", { "data-picture": file }, image, caption);
  const draw = async () => {
    const svg = await meshPicture(kept);
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
    save.addEventListener("click", () => download(`${name}.svg`, svg, "image/svg+xml"));
    save.hidden = false;
  };
  inTurn(draw).catch((error) =>
    image.replaceWith(element("p.problem", {}, `${title} could not be drawn: ${error.message}`)),
  );
  return figure;
}

/**
 * The meshes of a section that are figures of their own, side by side.
 * @param {object} section
 * @param {Object<string, object>} keptMeshes  JSON of schema ccdt.mesh/1, by file
 */
export function meshPictures(section, keptMeshes) {
  const meshes = section.meshes.filter(({ file, figure }) => figure && keptMeshes[file]);
  const names = figureNames(section.name, meshes.map(({ title }) => title));
  return meshes.length > 0
    ? element(
        "div.mesh-pictures",
        {},
        meshes.map((mesh, index) => picture(mesh, names[index], keptMeshes[mesh.file])),
      )
    : null;
}
