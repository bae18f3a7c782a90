const NAMESPACE = "http://www.w3.org/2000/svg";
const AXES = ["x", "y", "z"];
const SIZE = 72;
const LENGTH = 24;

/** A small mark of how the axes lie. */
export function createAxesMark() {
  const svg = document.createElementNS(NAMESPACE, "svg");
  svg.setAttribute("viewBox", `0 0 ${SIZE} ${SIZE}`);
  svg.setAttribute("class", "viewer-axes");
  svg.setAttribute("aria-hidden", "true");
  for (const axis of AXES) {
    svg.append(document.createElementNS(NAMESPACE, "line"));
    const text = document.createElementNS(NAMESPACE, "text");
    text.textContent = axis;
    svg.append(text);
  }
  return svg;
}

/** Turns the mark as the camera has turned; axes that point away are fainter. */
export function turnAxesMark(svg, camera) {
  const turn = camera.matrixWorldInverse.elements;
  AXES.forEach((_, axis) => {
    const [x, y, toward] = [turn[4 * axis], -turn[4 * axis + 1], turn[4 * axis + 2]];
    const at = (length) => [SIZE / 2 + length * x, SIZE / 2 + length * y];
    const [line, text] = [svg.children[2 * axis], svg.children[2 * axis + 1]];
    const set = (node, values) => Object.entries(values).forEach(([name, value]) => node.setAttribute(name, value));
    const [x1, y1] = at(0), [x2, y2] = at(LENGTH), [xText, yText] = at(LENGTH + 8);
    set(line, { x1, y1, x2, y2, opacity: toward < -0.1 ? 0.45 : 1 });
    set(text, { x: xText, y: yText });
  });
}
