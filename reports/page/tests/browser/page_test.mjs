/**
 * Opens the page of a report from disk, as a reader does.
 *
 * CCDT_PAGE: index.html of the report; CCDT_SCREENSHOTS: the folder that pictures of it are kept in.
 */
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { openPage, PHONE, startBrowser } from "./browser.mjs";
import { brightness, chartsDrawn, marksIn, overflow, reportOf, rowsIn } from "./page_steps.mjs";
import { changed, pixelsOf, slide, uncut, viewerOf } from "./viewer_steps.mjs";

const file = process.env.CCDT_PAGE;
const screenshots = process.env.CCDT_SCREENSHOTS;
const picture = (name) => join(screenshots, `${name}.png`);

// One visit of a reader with a laptop: opening a page takes long where others compute as well.
let browser, laptop;
before(async () => {
  mkdirSync(screenshots, { recursive: true });
  browser = await startBrowser();
  laptop = await openPage(browser, file);
}, { timeout: 120000 });
after(() => browser?.close());

/** Whatever is done to the page, it must not log errors or warnings, nor request anything. */
async function withoutTroubles({ page, troubles }, body) {
  await body(page);
  assert.deepEqual(troubles.splice(0), []);
}

function laptopTest(name, body) {
  test(name, { timeout: 120000 }, () => withoutTroubles(laptop, body));
}

function visitTest(name, options, body) {
  test(name, { timeout: 120000 }, async () => {
    const visit = await openPage(browser, file, options);
    try {
      await withoutTroubles(visit, body);
    } finally {
      await visit.page.context().close();
    }
  });
}

laptopTest("each claim is there with its verdict, and each experiment with its status", async (page) => {
  const report = await reportOf(page);
  assert.ok(report.claims.length > 0);
  for (const { id, verdict } of report.claims) {
    assert.equal(await page.locator(`[data-claim="${id}"]`).getAttribute("data-verdict"), verdict);
  }
  for (const { name, status } of report.experiments) {
    assert.equal(await page.locator(`[data-experiment="${name}"]`).getAttribute("data-status"), status);
    assert.equal(await page.locator(`[data-missing="${name}"]`).count(), status === "missing" ? 1 : 0);
    if (status === "missing") assert.match(await page.locator(`[data-missing="${name}"]`).textContent(), /[^.]\.$/);
  }
});

laptopTest("every chart is drawn with data", async (page) => {
  const report = await reportOf(page);
  const charts = report.experiments.flatMap((section) => section.charts.map((chart) => `${section.name}/${chart.name}`));
  assert.ok(charts.length > 0);
  await chartsDrawn(page);
  for (const chart of charts) {
    const marks = await marksIn(page.locator(`[data-chart="${chart}"]`));
    assert.ok(marks > 0, `${chart} has ${marks} marks`);
  }
  await page.screenshot({ path: picture("laptop-light"), fullPage: true });
});

laptopTest("a filter takes rows from the tables and marks from the charts, and gives them back", async (page) => {
  await chartsDrawn(page);
  const section = page.locator("[data-experiment]:has([data-chart]):has([data-table]):has(details.filter)").first();
  const name = await section.getAttribute("data-experiment");
  const before = { rows: await rowsIn(section), marks: await marksIn(section) };

  const filter = section.locator("details.filter").first();
  await filter.locator("summary").click();
  await filter.locator("button.only").first().click();
  await page.waitForFunction(([experiment, marks]) => {
    const node = document.querySelector(`[data-experiment="${experiment}"]`);
    const now = node.querySelectorAll("svg g.role-mark:not(.mark-text):not(.mark-group) > *").length;
    return now !== marks && [...node.querySelectorAll(".drawing")].every((drawing) => drawing.dataset.drawn === "true");
  }, [name, before.marks]);
  assert.ok((await rowsIn(section)) < before.rows);
  assert.ok((await marksIn(section)) < before.marks);
  assert.ok((await rowsIn(section)) > 0);
  await section.screenshot({ path: picture("filtered") });

  await filter.getByRole("button", { name: "All", exact: true }).click();
  await page.waitForFunction(([experiment, marks]) => {
    const node = document.querySelector(`[data-experiment="${experiment}"]`);
    return node.querySelectorAll("svg g.role-mark:not(.mark-text):not(.mark-group) > *").length === marks;
  }, [name, before.marks]);
  assert.equal(await rowsIn(section), before.rows);
});

laptopTest("a number leads to its runs, the command that repeats them, and their JSON", async (page) => {
  const report = await reportOf(page);
  await page.locator("[data-table] tbody tr [data-trace]").first().click();
  const dialog = page.locator("dialog.trace[open]");
  const run = dialog.locator("details.run[open]").first();
  const runFile = await run.getAttribute("data-run");
  assert.ok(report.runs[runFile], runFile);
  assert.equal(await run.locator(".command code").textContent(), report.runs[runFile].command);
  await page.screenshot({ path: picture("trace") });

  await run.locator("details.raw summary").click();
  await run.locator("details.raw pre", { hasText: '"ccdt.run/1"' }).waitFor();
  const [download] = await Promise.all([page.waitForEvent("download"), run.getByRole("button", { name: "Download" }).click()]);
  assert.equal(JSON.parse(readFileSync(await download.path(), "utf8")).schema, "ccdt.run/1");

  await dialog.getByRole("button", { name: "Close" }).click();
  assert.equal(await page.locator("dialog.trace[open]").count(), 0);
});

laptopTest("the switch makes the page dark, and light again", async (page) => {
  await chartsDrawn(page);
  const light = await brightness(page);
  await page.locator("[data-theme-switch]").click();
  const dark = await brightness(page);
  assert.ok(light > 200 && dark < 60, `${light}, then ${dark}`);
  await page.screenshot({ path: picture("laptop-dark"), fullPage: true });
  await page.locator("[data-theme-switch]").click();
  assert.equal(await brightness(page), light);
});

visitTest("a system that is dark gets a dark page", { colorScheme: "dark" }, async (page) => {
  assert.ok((await brightness(page)) < 60);
});

visitTest("on a phone nothing is wider than the window", { viewport: PHONE, isMobile: true, hasTouch: true }, async (page) => {
  await chartsDrawn(page);
  await viewerOf(page);
  assert.equal(await overflow(page), 0);
  await page.screenshot({ path: picture("phone"), fullPage: true });
});

laptopTest("the viewer draws a mesh, and turns it by mouse and by keys", async (page) => {
  const { canvas, control, state } = await viewerOf(page);
  const { drawn, colors } = await pixelsOf(page, canvas);
  assert.ok(drawn > 0.05 && colors > 20, `${drawn} of the pixels are drawn, in ${colors} colors`);

  const first = (await state()).cameraPosition;
  const { x, y, width, height } = await canvas.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 90, y + height / 2 + 30, { steps: 3 });
  await page.mouse.up();
  await changed(page, "cameraPosition", first);

  const turned = (await state()).cameraPosition;
  await canvas.press("ArrowLeft");
  await changed(page, "cameraPosition", turned);
  await control("reset").click();
  await page.waitForFunction((position) => document.querySelector("[data-viewer]").dataset.cameraPosition === position, first);
});

laptopTest("the viewer cuts the mesh: fewer and fewer tetrahedra are shown", async (page) => {
  const { axis, control, shown, state, viewer } = await viewerOf(page);
  const cutOpen = await shown();
  const whole = await uncut(page);
  assert.ok(cutOpen > 0 && cutOpen < whole);
  assert.ok((await viewer.locator("[data-readout]").textContent()).includes(`${whole.toLocaleString("en-US")} tetrahedra`));

  await axis("x").check();
  await changed(page, "shownTetrahedra", String(whole));
  const half = await shown();
  await slide(control("cut-position"), 0.3);
  await changed(page, "shownTetrahedra", String(half));
  const third = await shown();
  await control("cut-flip").click();
  await changed(page, "shownTetrahedra", String(third));
  assert.equal(third + (await shown()), whole, "what one side lacks the other has");
  assert.equal((await state()).color, "plain");
});

laptopTest("the viewer colors by quality, and shows only the worst tetrahedra", async (page) => {
  const { canvas, control, shown, viewer } = await viewerOf(page);
  const whole = await uncut(page);
  await control("color").selectOption("dihedral");
  await changed(page, "color", "plain");
  assert.ok((await viewer.locator(".viewer-legend").textContent()).includes("smallest dihedral angle"));
  await viewer.screenshot({ path: picture("viewer-dihedral") });

  await control("worst").selectOption("r");
  await changed(page, "shownTetrahedra", String(whole));
  const some = await shown();
  assert.ok(some > 0 && some < whole);
  await slide(control("worst-count"), 0.2);
  await changed(page, "shownTetrahedra", String(some));
  assert.ok((await shown()) < some);
  assert.ok(Number(await control("worst-threshold").inputValue()) >= 1);
  assert.ok((await pixelsOf(page, canvas)).drawn > 0);
  await viewer.screenshot({ path: picture("viewer-worst") });
  await control("worst").selectOption("none");
  await control("color").selectOption("plain");
  await changed(page, "color", "dihedral");
});

laptopTest("a click on the mesh tells about the tetrahedron there", async (page) => {
  const { canvas, state, viewer } = await viewerOf(page);
  await uncut(page);
  const { width, height } = await canvas.boundingBox();
  // Meshes have holes: some place near the middle has a face.
  for (const [right, down] of [[0, 0], [-60, 0], [60, 0], [0, -60], [0, 60], [-90, -90], [90, 90]]) {
    await canvas.click({ position: { x: width / 2 + right, y: height / 2 + down } });
    await page.waitForTimeout(50);
    if ((await state()).pickedTetrahedron !== undefined) break;
  }
  assert.notEqual((await state()).pickedTetrahedron, undefined);
  assert.match(await viewer.locator("[data-picked]").textContent(), /dihedral angles.*vertices/);
  await viewer.screenshot({ path: picture("viewer-picked") });
});

laptopTest("each mesh of the report can be chosen", async (page) => {
  const { control, viewer } = await viewerOf(page);
  const report = await reportOf(page);
  const files = report.experiments.flatMap(({ meshes }) => meshes.map((mesh) => mesh.file));
  assert.equal(await control("mesh").locator("option").count(), files.length);
  for (const [place, name] of files.entries()) {
    await control("mesh").selectOption(String(place));
    await page.waitForSelector(`[data-viewer][data-viewer-mesh="${name}"]`);
    assert.ok(Number(await viewer.getAttribute("data-shown-tetrahedra")) > 0, name);
    const { run } = report.experiments.flatMap(({ meshes }) => meshes).find((mesh) => mesh.file === name);
    assert.equal(await viewer.locator(".command code").textContent(), report.runs[run].command);
  }
});
