import { existsSync } from "node:fs";
import { pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

const PROGRAM = process.env.CCDT_CHROMIUM ?? "/usr/bin/chromium";

/** A warning of Chromium about its own WebGL, when a screenshot is taken. The page did not cause it. */
const DRIVER_MESSAGE = /GL Driver Message \(OpenGL, Performance,/;

/** No screen, no graphics card, no network: SwiftShader computes WebGL on the processor. */
const FLAGS = [
  "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];

export const LAPTOP = { width: 1366, height: 800 };
export const PHONE = { width: 390, height: 844 };

/** @throws {Error} that says what to install */
export async function startBrowser() {
  if (!existsSync(PROGRAM)) {
    throw new Error(`This test looks at the page with ${PROGRAM}, which is not installed; "tools/setup test" installs it.`);
  }
  return chromium.launch({ executablePath: PROGRAM, args: FLAGS });
}

/**
 * Opens a page from disk. Collects as text what it must not do: errors, warnings, and requests for anything but itself.
 * @param {import("playwright-core").Browser} browser
 * @param {string} file
 * @param {object} [options]  of the browser's context: `viewport`, `colorScheme`, ...
 * @returns {Promise<{page: import("playwright-core").Page, troubles: string[]}>}
 */
export async function openPage(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: LAPTOP, colorScheme: "light", ...options });
  const page = await context.newPage();
  const address = pathToFileURL(file).href;
  const troubles = [];
  page.on("console", (message) => {
    const isTrouble = ["error", "warning"].includes(message.type()) && !DRIVER_MESSAGE.test(message.text());
    if (isTrouble) troubles.push(`console ${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => troubles.push(`uncaught: ${error.message}`));
  page.on("request", (request) => {
    const url = request.url();
    if (url.split("#")[0] !== address && !url.startsWith("data:") && !url.startsWith("blob:")) troubles.push(`asked for ${url}`);
  });
  await page.goto(address);
  return { page, troubles };
}
