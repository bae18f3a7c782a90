import { boundaryOf, neighborsOf } from "./boundary.mjs";
import { allCells, centroidsOf, cutAway, extentAlong } from "./cut.mjs";
import { unpackMesh } from "./kept_mesh.mjs";
import { regionColors } from "./palette.mjs";
import { shadesOf } from "./shading.mjs";
import { visibleFaces } from "./visible_faces.mjs";

/** The width of edges, in units of the picture: its bounds, and its share of the size of a triangle. */
const EDGE_WIDTH = { smallest: 0.06, largest: 0.35, share: 0.05 };

/**
 * Draws a mesh cut open, as papers do: the quarter toward the observer is taken away, in whole tetrahedra, or the half
 * where the quarter shows the inside of some of the regions only. What is laid open has another color than the surface.
 * @param {object} kept  a mesh of schema `ccdt.mesh/1`
 * @param {object} [options]
 * @param {number} [options.size]       of the longer side of the picture, in its units; the other follows from the mesh
 * @param {number} [options.azimuth]    degrees: where the observer is, about the z axis from the x axis
 * @param {number} [options.elevation]  degrees above the xy plane
 * @returns {Promise<string>} SVG
 * @throws {Error} when the mesh cannot be unpacked
 */
export async function meshPicture(kept, { size = 480, azimuth = -62, elevation = 28 } = {}) {
  const mesh = await unpackMesh(kept);
  const faces = cutOpen(mesh, kept.vertices, azimuth);
  const projection = project(mesh.points, faces.corners, viewOf(azimuth, elevation), size);
  return svgOf(mesh, faces, projection);
}

const radians = (degrees) => (degrees * Math.PI) / 180;

function cutOpen(mesh, vertexCount, azimuth) {
  const neighbors = neighborsOf(mesh.cells, vertexCount);
  const centroids = centroidsOf(mesh);
  const regionCount = new Set(mesh.regions).size;
  const quarter = planesTowards(mesh.points, azimuth);
  const half = [quarter[Math.abs(Math.cos(radians(azimuth))) > Math.SQRT1_2 ? 0 : 1]];
  let faces;
  for (const planes of [quarter, half]) {
    const shown = allCells(mesh.regions.length);
    cutAway(centroids, planes, shown);
    faces = boundaryOf(mesh.cells, neighbors, shown);
    const laidOpen = new Set(faces.cell.filter((_, face) => faces.cut[face]).map((cell) => mesh.regions[cell]));
    if (laidOpen.size === regionCount) break;
  }
  return faces;
}

// Two planes through the middle of the mesh, one across x and one across y.
function planesTowards(points, azimuth) {
  const normals = [[Math.sign(Math.cos(radians(azimuth))) || 1, 0, 0], [0, Math.sign(Math.sin(radians(azimuth))) || 1, 0]];
  return normals.map((normal) => {
    const { low, high } = extentAlong(points, normal);
    return { normal, offset: (low + high) / 2 };
  });
}

// Unit vectors to the right and up in the picture, and out of it.
function viewOf(azimuth, elevation) {
  const [a, e] = [radians(azimuth), radians(elevation)];
  return {
    right: [-Math.sin(a), Math.cos(a), 0],
    up: [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
    toward: [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)],
  };
}

// In parallel, what is drawn fills the picture; y downwards as in SVG, depth toward the observer.
function project(points, drawn, { right, up, toward }, size) {
  const drawnPoints = new Float32Array(3 * drawn.length).map((_, i) => points[3 * drawn[Math.floor(i / 3)] + (i % 3)]);
  const across = extentAlong(drawnPoints, right), along = extentAlong(drawnPoints, up);
  const margin = 0.01 * size;
  const scale = (size - 2 * margin) / (Math.max(across.high - across.low, along.high - along.low) || 1);
  const coordinates = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3) {
    const dot = (v) => v[0] * points[i] + v[1] * points[i + 1] + v[2] * points[i + 2];
    coordinates[i] = margin + scale * (dot(right) - across.low);
    coordinates[i + 1] = margin + scale * (along.high - dot(up));
    coordinates[i + 2] = scale * dot(toward);
  }
  const [width, height] = [across, along].map(({ low, high }) => Math.ceil(scale * (high - low) + 2 * margin));
  return { coordinates, width, height };
}

function svgOf(mesh, faces, { coordinates, width, height }) {
  const order = visibleFaces(faces.corners, coordinates, width, height);
  const colors = regionColors(mesh.regions);
  const shades = new Map();
  const paths = [];
  let edgeLengths = 0;
  for (const face of order) {
    const [a, b, c] = [0, 1, 2].map((i) => 3 * faces.corners[3 * face + i]);
    const color = colors.get(mesh.regions[faces.cell[face]])[faces.cut[face] ? "cut" : "surface"];
    if (!shades.has(color)) shades.set(color, shadesOf(color));
    paths.push(`<path fill="${shades.get(color)(coordinates, a, b, c)}" d="${outline(coordinates, a, b, c)}"/>`);
    edgeLengths += Math.hypot(coordinates[b] - coordinates[a], coordinates[b + 1] - coordinates[a + 1]);
  }
  const edge = (EDGE_WIDTH.share * edgeLengths) / Math.max(1, order.length);
  const edgeWidth = Math.min(EDGE_WIDTH.largest, Math.max(EDGE_WIDTH.smallest, edge));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
    `viewBox="0 0 ${width} ${height}" role="img">\n<title>${escaped(mesh.title)}, cut open</title>\n` +
    `<g stroke="#1c2733" stroke-width="${edgeWidth.toFixed(2)}" stroke-linejoin="round">\n${paths.join("\n")}\n</g>\n</svg>\n`;
}

// Hundredths of a unit are finer than any print, and keep the file small.
function outline(coordinates, a, b, c) {
  const text = (i) => `${round(coordinates[i])} ${round(coordinates[i + 1])}`;
  return `M${text(a)}L${text(b)} ${text(c)}Z`;
}
const round = (value) => Math.round(100 * value) / 100;

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
