import { element } from "./dom.mjs";

/**
 * The meshes that were kept, in a viewer.
 * @param {object} report
 * @param {Object<string, object>} keptMeshes  JSON of schema ccdt.mesh/1, by file
 * @param {(container: Element, keptMeshes: object, report: object) => void} mount  puts the viewer into its place
 * @returns {Element|null}  null: no mesh was kept
 */
export function meshSection(report, keptMeshes, mount) {
  const meshes = report.experiments.flatMap((section) => section.meshes);
  if (meshes.length === 0) return null;
  const place = element("div", { id: "viewer" });
  const node = element(
    "section.part",
    { id: "meshes", "aria-labelledby": "meshes-title" },
    element("h2", { id: "meshes-title" }, "Meshes"),
    element(
      "p.lead",
      {},
      "Turn them, cut them with a plane, color them by quality, and look at the worst tetrahedra alone.",
    ),
    place,
  );
  // A viewer takes its size from the page.
  queueMicrotask(() => mount(place, keptMeshes, { meshes, runs: report.runs }));
  return node;
}
