import config from "../../../charts/config.json" with { type: "json" };
import { element } from "./dom.mjs";

const STORE = "ccdt-report-theme";

/** The font of the page, for charts in it. */
export function pageFont() {
  return getComputedStyle(document.body).fontFamily;
}

/**
 * The colors of charts, as custom properties that follow the theme: a chart in the page is drawn once for both.
 */
export function defineChartColors() {
  const style = document.documentElement.style;
  for (const [name, light] of Object.entries(config.palettes.light))
    style.setProperty(`--chart-${name}`, `light-dark(${light}, ${config.palettes.dark[name]})`);
  for (const name of ["text", "quiet", "axis", "grid"])
    style.setProperty(`--chart-${name}`, `light-dark(${config.themes.light[name]}, ${config.themes.dark[name]})`);
}

function stored() {
  try {
    return localStorage.getItem(STORE);
  } catch {
    return null;
  }
}

function store(theme) {
  try {
    localStorage.setItem(STORE, theme);
  } catch {
    // Without storage, the choice is lost at the end of the visit.
  }
}

function systemTheme() {
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/**
 * A switch between light and dark. It starts with the reader's earlier choice, or else with the theme of the system.
 * The attribute `data-theme` of the root holds the theme.
 */
export function themeSwitch() {
  const root = document.documentElement;
  const button = element("button.small.theme", { type: "button", "data-theme-switch": "" });
  const show = (theme) => {
    root.dataset.theme = theme;
    const other = theme === "dark" ? "light" : "dark";
    button.textContent = other === "dark" ? "Dark" : "Light";
    button.setAttribute("aria-label", `Show the page ${other}`);
  };
  button.addEventListener("click", () => {
    show(root.dataset.theme === "dark" ? "light" : "dark");
    store(root.dataset.theme);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => show(stored() ?? systemTheme()));
  show(["light", "dark"].includes(stored()) ? stored() : systemTheme());
  return button;
}
