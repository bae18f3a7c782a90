import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, OrthographicCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";

/** Where the observer is at first, from the middle of the mesh: as in the pictures of the report. */
const FIRST_VIEW = new Vector3(0.41, -0.78, 0.47).normalize();

/** The largest share of the sphere around a mesh that the mesh itself usually fills. */
const FILLED = 0.86;

/** Edges are drawn fainter where they are so dense that they would hide the colors: by their length in pixels. */
const EDGE_OPACITY = { faintest: 0.12, strongest: 0.65, pixels: 16 };

/**
 * The three-dimensional part of the viewer: triangles with their edges, an outline around them, and one cell marked.
 * Nothing is drawn until `draw` is called.
 * @param {HTMLCanvasElement} canvas
 */
export function createScene(canvas) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
  const camera = new OrthographicCamera();
  camera.up.set(0, 0, 1);
  const light = new DirectionalLight(0xffffff, 2.0);
  light.position.set(-0.35, 0.6, 0.72);
  camera.add(light);

  const parts = {
    triangles: new Mesh(new BufferGeometry(), new MeshLambertMaterial({
      vertexColors: true, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    })),
    edges: new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true })),
    hull: new Mesh(new BufferGeometry(), new MeshBasicMaterial({ transparent: true, opacity: 0.07, depthWrite: false })),
    outline: new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.45 })),
    marked: new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false, transparent: true })),
  };
  const scene = new Scene();
  scene.add(camera, new AmbientLight(0xffffff, 1.6), ...Object.values(parts));
  return { renderer, camera, scene, parts, edgeLength: 1 };
}

/** Puts the camera where it was at first, so that all of a sphere is in view. */
export function lookAt({ camera }, { center, radius }) {
  camera.position.set(...center).addScaledVector(FIRST_VIEW, 4 * radius);
  camera.near = 0.1 * radius;
  camera.far = 20 * radius;
  camera.zoom = 1;
  camera.lookAt(...center);
}

/** Fits the picture to the size of the canvas in the page, and to a mesh within a sphere of this radius. */
export function fit(stage, width, height, radius) {
  const { renderer, camera } = stage;
  renderer.setSize(width, height, false);
  const half = (FILLED * radius) / Math.min(width, height);
  Object.assign(camera, { left: -half * width, right: half * width, top: half * height, bottom: -half * height });
  camera.updateProjectionMatrix();
}

/**
 * @param {Float32Array} positions  x y z of three corners per triangle
 * @param {string[]} colors        one per triangle
 * @param {Float32Array} edges      x y z of two ends per edge
 */
export function setTriangles(stage, positions, colors, edges) {
  const { triangles, edges: lines } = stage.parts;
  replaceGeometry(triangles, positions).setAttribute("color", new BufferAttribute(cornerColors(colors), 3));
  replaceGeometry(lines, edges);
  stage.edgeLength = meanLength(edges);
}

/** Lines around what is shown, and the faint surface within; empty arrays: none. */
export function setOutline({ parts }, hull, outline) {
  replaceGeometry(parts.hull, hull);
  replaceGeometry(parts.outline, outline);
}

/** The edges of the marked cell; an empty array: none is marked. */
export const setMarked = ({ parts }, edges) => replaceGeometry(parts.marked, edges);

/** Takes colors of lines from the page's theme. */
export function setLineColors({ parts }, { edge, outline, marked }) {
  parts.edges.material.color.set(edge);
  for (const part of [parts.hull, parts.outline]) part.material.color.set(outline);
  parts.marked.material.color.set(marked);
}

export function draw({ renderer, camera, scene, parts, edgeLength }) {
  const { height } = renderer.getSize(new Vector2());
  const pixels = (edgeLength * camera.zoom * height) / (camera.top - camera.bottom);
  const { faintest, strongest } = EDGE_OPACITY;
  parts.edges.material.opacity = Math.min(strongest, Math.max(faintest, (strongest * pixels) / EDGE_OPACITY.pixels));
  renderer.render(scene, camera);
}

/** The triangle at a place of the canvas, -1 to 1 to the right and upwards; null: none is there. */
export function triangleAt({ camera, parts }, x, y) {
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2(x, y), camera);
  return ray.intersectObject(parts.triangles, false)[0]?.faceIndex ?? null;
}

/** Unit vector from the mesh to the observer. */
export function towardsObserver({ camera }) {
  return camera.getWorldDirection(new Vector3()).negate().toArray();
}

function replaceGeometry(object, positions) {
  object.geometry.dispose();
  object.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
  object.visible = positions.length > 0;
  return object.geometry;
}

function cornerColors(colors) {
  const known = new Map();
  const values = new Float32Array(9 * colors.length);
  colors.forEach((name, face) => {
    if (!known.has(name)) known.set(name, new Color(name).toArray());
    for (let corner = 0; corner < 3; ++corner) values.set(known.get(name), 9 * face + 3 * corner);
  });
  return values;
}

function meanLength(edges) {
  let sum = 0;
  for (let i = 0; i < edges.length; i += 6) {
    sum += Math.hypot(edges[i + 3] - edges[i], edges[i + 4] - edges[i + 1], edges[i + 5] - edges[i + 2]);
  }
  return edges.length > 0 ? sum / (edges.length / 6) : 1;
}
