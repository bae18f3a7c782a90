import { rgb } from "d3-color";

/** Where the light comes from, as the viewer sees it: x to the right, y down, z toward the viewer. */
const LIGHT = normalized([-0.35, -0.6, 0.72]);

/** How bright a face in full shadow is, and how bright one that looks into the light. */
const BRIGHTNESS = { shadow: 0.62, light: 1.06 };

/** Few enough shades that neighboring faces share them, and enough that no steps are visible. */
const SHADES = 48;

function normalized(v) {
  const length = Math.hypot(...v);
  return v.map((component) => component / length);
}

/**
 * Shades of one color for flat faces.
 * @param {string} color
 * @returns {(coordinates: Float32Array, a: number, b: number, c: number) => string} the color of the face whose
 *          corners' coordinates begin at a, b and c
 */
export function shadesOf(color) {
  const shades = Array.from({ length: SHADES }, (_, i) => shade(color, i / (SHADES - 1)));
  return (coordinates, a, b, c) => shades[Math.round((SHADES - 1) * lightOn(coordinates, a, b, c))];
}

function shade(color, light) {
  const { r, g, b } = rgb(color);
  const factor = BRIGHTNESS.shadow + (BRIGHTNESS.light - BRIGHTNESS.shadow) * light;
  return rgb(factor * r, factor * g, factor * b).clamp().formatHex();
}

// 0 to 1. Seen from outside, corners run clockwise, as y points downwards.
function lightOn(p, a, b, c) {
  const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
  const v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
  const normal = [v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]];
  const length = Math.hypot(...normal);
  if (length === 0) return 0;
  return Math.max(0, (normal[0] * LIGHT[0] + normal[1] * LIGHT[1] + normal[2] * LIGHT[2]) / length);
}
