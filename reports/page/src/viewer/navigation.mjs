import { MOUSE } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const TURN = Math.PI / 24;
const ZOOM = 1.2;
/** Pixels: a pointer that has moved less between down and up has clicked. */
const CLICK = 5;

/**
 * Turns, shifts and zooms the camera by mouse, touch and keyboard. The wheel zooms only while the canvas has the focus,
 * so that it does not catch those who scroll past.
 * @param {HTMLCanvasElement} canvas
 * @param {import("three").Camera} camera
 * @param {{changed: () => void, clicked: (event: PointerEvent) => void}} on
 */
export function navigate(canvas, camera, on) {
  const orbit = new OrbitControls(camera, canvas);
  orbit.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
  orbit.enableZoom = false;
  orbit.minZoom = 0.5;
  orbit.maxZoom = 200;
  orbit.addEventListener("change", on.changed);
  canvas.addEventListener("focus", () => (orbit.enableZoom = true));
  canvas.addEventListener("blur", () => (orbit.enableZoom = false));
  canvas.addEventListener("keydown", (event) => turnByKey(orbit, event));

  let down = null;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    down = event.isPrimary ? event : null;
  });
  canvas.addEventListener("pointerup", (event) => {
    const moved = down ? Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) : Infinity;
    if (event.button === 0 && moved < CLICK) on.clicked(event);
  });
  return {
    startFrom: (center) => {
      orbit.target.set(...center);
      orbit.update();
      orbit.saveState();
    },
    reset: () => orbit.reset(),
    zoomIn: () => orbit.dollyIn(1 / ZOOM),
    zoomOut: () => orbit.dollyOut(1 / ZOOM),
  };
}

function turnByKey(orbit, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const actions = {
    ArrowLeft: () => orbit.rotateLeft(TURN),
    ArrowRight: () => orbit.rotateLeft(-TURN),
    ArrowUp: () => orbit.rotateUp(TURN),
    ArrowDown: () => orbit.rotateUp(-TURN),
    "+": () => orbit.dollyIn(1 / ZOOM),
    "-": () => orbit.dollyOut(1 / ZOOM),
    Home: () => orbit.reset(),
  };
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}
