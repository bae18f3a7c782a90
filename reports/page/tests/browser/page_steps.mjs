/** The report that a page has in it. */
export const reportOf = (page) => page.evaluate(async () => {
  const plain = document.getElementById("ccdt-report");
  if (plain) return JSON.parse(plain.textContent);
  const base64 = document.getElementById("ccdt-packed-report").textContent;
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
});

/** Marks with which data are drawn, in a chart or in all charts of a section: no axes, legends and words. */
export const marksIn = (locator) =>
  locator.evaluate((node) => node.querySelectorAll("svg g.role-mark:not(.mark-text):not(.mark-group) > *").length);

/** Waits until all charts of the page, or of a section, are drawn. */
export async function chartsDrawn(page, within = "body") {
  await page.waitForFunction(
    (selector) => [...document.querySelectorAll(`${selector} [data-chart] .drawing`)].every((drawing) => drawing.dataset.drawn === "true"),
    within, { timeout: 60000 });
}

/** Rows that the tables of a section show or fold away. */
export const rowsIn = (locator) => locator.locator("[data-table] tbody tr").count();

/** How many pixels the page is wider than the window. */
export const overflow = (page) =>
  page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

/** How bright the background of the page is, from 0 to 255. */
export const brightness = (page) => page.evaluate(() => {
  const numbers = getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(Number);
  return numbers.reduce((sum, number) => sum + number, 0) / 3;
});
