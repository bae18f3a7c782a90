import assert from "node:assert/strict";

/** The viewer of a page, with a mesh in it. */
export async function viewerOf(page) {
  const viewer = page.locator("[data-viewer]");
  await viewer.scrollIntoViewIfNeeded();
  await page.waitForSelector("[data-viewer][data-viewer-mesh]", { timeout: 30000 });
  const canvas = viewer.locator("canvas").first();
  return {
    viewer,
    canvas,
    control: (name) => viewer.locator(`[data-control="${name}"]`),
    axis: (value) => viewer.locator(`[data-control="cut-axis"][value="${value}"]`),
    /** What the viewer tells of itself. */
    state: () => viewer.evaluate((node) => ({ ...node.dataset })),
    shown: async () => Number(await viewer.getAttribute("data-shown-tetrahedra")),
  };
}

/** Waits until a value that the viewer tells of itself has changed. */
export async function changed(page, name, before) {
  await page.waitForFunction(([key, old]) => document.querySelector("[data-viewer]").dataset[key] !== old, [name, before]);
}

/** Shows the whole mesh. @returns {Promise<number>} how many tetrahedra it has */
export async function uncut(page) {
  const { axis, shown } = await viewerOf(page);
  const before = await shown();
  if (!(await axis("none").isChecked())) {
    await axis("none").check();
    await changed(page, "shownTetrahedra", String(before));
  }
  return shown();
}

/** Moves a slider to a share of its length, as a hand would. */
export async function slide(locator, share) {
  await locator.evaluate((input, part) => {
    input.value = Number(input.min) + part * (input.max - input.min);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, share);
}

/** How many pixels of the canvas are not background, and how many colors they have; taken from a picture of it. */
export async function pixelsOf(page, canvas) {
  const picture = (await canvas.screenshot()).toString("base64");
  const result = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const { width, height } = image;
    const drawing = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d");
    drawing.drawImage(image, 0, 0);
    const values = new Uint32Array(drawing.getImageData(0, 0, width, height).data.buffer);
    // Nothing is drawn in the corner above on the right.
    const background = values[width * 8 - 8];
    return { drawn: values.filter((value) => value !== background).length / values.length, colors: new Set(values).size };
  }, picture);
  assert.ok(Number.isFinite(result.drawn));
  return result;
}
