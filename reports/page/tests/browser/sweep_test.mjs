/**
 * Opens the page of a large sweep from disk, as a reader does.
 *
 * CCDT_SWEEP_PAGE: index.html of the report of 2,000 cases; CCDT_SCREENSHOTS: the folder that pictures of it are kept in.
 */
import assert from "node:assert/strict";
import { mkdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { openPage, PHONE, startBrowser } from "./browser.mjs";
import { chartsDrawn, marksIn, overflow, reportOf } from "./page_steps.mjs";

const file = process.env.CCDT_SWEEP_PAGE;
const picture = (name) => join(process.env.CCDT_SCREENSHOTS, `${name}.png`);

const LARGEST_PAGE = 10e6; // bytes
const MOST_ROWS = 100; // of a table in the page at once
const LONGEST_ANSWER = 500; // milliseconds; it is below 100 on a computer that does nothing else
const CHARTS = ["scaling", "cactus", "pairs", "pareto", "heat-seconds-lattice-locator", "failures"];

let browser, laptop;
before(async () => {
  mkdirSync(process.env.CCDT_SCREENSHOTS, { recursive: true });
  browser = await startBrowser();
  laptop = await openPage(browser, file);
}, { timeout: 120000 });
after(() => browser?.close());

function laptopTest(name, body) {
  test(name, { timeout: 120000 }, async (context) => {
    await body(laptop.page, context);
    assert.deepEqual(laptop.troubles.splice(0), []);
  });
}

const cases = (page) => page.locator('[data-table="sweep/cases"]');
const rows = (page) => cases(page).locator("tbody tr");

test("the page of 2,000 cases is smaller than 10 MB", (context) => {
  const { size } = statSync(file);
  context.diagnostic(`${(size / 1e6).toFixed(2)} MB`);
  assert.ok(size < LARGEST_PAGE, `${size} bytes`);
});

laptopTest("each kind of chart is drawn with data", async (page) => {
  await chartsDrawn(page);
  for (const chart of CHARTS) assert.ok((await marksIn(page.locator(`[data-chart="sweep/${chart}"]`))) > 0, chart);
  await page.screenshot({ path: picture("sweep-light"), fullPage: true });
  await page.locator("[data-theme-switch]").click();
  await page.screenshot({ path: picture("sweep-dark"), fullPage: true });
  await page.locator("[data-theme-switch]").click();
});

laptopTest("a long table has pages", async (page) => {
  const all = (await reportOf(page)).experiments[0].tables.find(({ name }) => name === "cases").rows.length;
  assert.equal(all, 2000);
  assert.ok((await rows(page).count()) <= MOST_ROWS);
  await cases(page).locator(".unfold").click();
  assert.equal(await rows(page).count(), MOST_ROWS);
  const first = await rows(page).first().textContent();
  await cases(page).getByRole("button", { name: "Next" }).click();
  assert.equal(await rows(page).count(), MOST_ROWS);
  assert.notEqual(await rows(page).first().textContent(), first);
  await cases(page).getByRole("button", { name: "Back" }).click();
  assert.equal(await rows(page).first().textContent(), first);
  await cases(page).locator(".unfold").click();
});

/** Clicks on "only" of a filter's value; how many milliseconds until the tables are laid out anew. */
const filterTime = (page, name, place) => page.evaluate(([filter, at]) => {
  const button = document.querySelectorAll(`[data-filter="sweep/${filter}"] button.only`)[at];
  const start = performance.now();
  button.click();
  document.body.getBoundingClientRect(); // lays the page out
  return performance.now() - start;
}, [name, place]);

laptopTest("a filter is answered at once", async (page, context) => {
  await chartsDrawn(page);
  const times = [];
  for (const [name, place] of [["mesher", 0], ["lattice", 1], ["mesher", 1], ["lattice", 0]]) {
    times.push(await filterTime(page, name, place));
    await chartsDrawn(page);
  }
  context.diagnostic(`milliseconds: ${times.map((time) => time.toFixed(0)).join(", ")}`);
  assert.ok(Math.max(...times) < LONGEST_ANSWER, times.join(", "));
  assert.match(await cases(page).locator("header").textContent(), /of 2,000 rows/);
  assert.ok((await rows(page).count()) <= MOST_ROWS);
  await page.getByRole("button", { name: "Show everything" }).click();
  await chartsDrawn(page);
});

laptopTest("a cell of a map leads to the runs of its cases", async (page) => {
  const map = page.locator('[data-chart="sweep/heat-seconds-lattice-locator"]');
  await map.scrollIntoViewIfNeeded();
  await map.locator("svg g.role-mark.mark-rect > path").first().click({ position: { x: 4, y: 4 } });
  const dialog = page.locator("dialog.trace[open]");
  assert.ok((await dialog.locator("details.run").count()) > 1);
  const run = dialog.locator("details.run").first();
  const name = await run.getAttribute("data-run");
  const report = await reportOf(page);
  assert.equal(await run.locator(".command code").textContent(), report.runs[name].command);
  assert.equal(await run.locator(`a[href="${name}"]`).count(), 1, "the record is beside the page, not in it");
  await page.screenshot({ path: picture("sweep-trace") });
  await dialog.getByRole("button", { name: "Close" }).click();
});

test("on a phone nothing is wider than the window", { timeout: 120000 }, async () => {
  const { page, troubles } = await openPage(browser, file, { viewport: PHONE, isMobile: true, hasTouch: true });
  await chartsDrawn(page);
  assert.equal(await overflow(page), 0);
  await page.screenshot({ path: picture("sweep-phone"), fullPage: true });
  assert.deepEqual(troubles, []);
  await page.context().close();
});
