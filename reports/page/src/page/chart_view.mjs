import { drawn } from "../charts/draw.mjs";
import { element } from "./dom.mjs";
import { download } from "./downloads.mjs";
import { inTurn } from "./in_turn.mjs";
import { factsOf } from "./mark_facts.mjs";
import { openTrace } from "./trace.mjs";
import { tooltipOf } from "./tooltip.mjs";
import { pageFont } from "./theme.mjs";
import { PRINT_WIDTH } from "../charts/print.mjs";

const PNG_SCALE = 3;
const NARROWEST = 240;

/** As for print: light, in the width and the font of the static figures. */
async function printView(section, chart, passes) {
  return (await drawn(section, chart, { theme: "light", width: PRINT_WIDTH, passes })).view;
}

async function saveAsSvg(section, chart, passes) {
  const view = await printView(section, chart, passes);
  download(`${section.name}-${chart.name}.svg`, await view.toSVG(), "image/svg+xml");
  view.finalize();
}

async function saveAsPng(section, chart, passes) {
  const view = await printView(section, chart, passes);
  const canvas = await view.toCanvas(PNG_SCALE);
  canvas.toBlob((blob) => download(`${section.name}-${chart.name}.png`, blob));
  view.finalize();
}

/**
 * A chart in the page.
 * @param {object} report
 * @param {object} section
 * @param {object} chart
 * @returns {{node: Element, show: (passes: (row: object, table: object) => boolean) => void}}
 */
export function chartView(report, section, chart) {
  const drawing = element("div.drawing", { role: "img", "aria-label": `${chart.title}. ${chart.caption}` });
  const id = `${section.name}-chart-${chart.name}`;
  let passes = () => true,
    view = null,
    drawnWidth = 0,
    room,
    wanted = 0;

  async function draw(turn) {
    const width = Math.floor(drawing.clientWidth);
    if (turn !== wanted || width < NARROWEST) return;
    delete drawing.dataset.drawn;
    const hasData = section.tables.some(
      (table) => chart.tables.includes(table.name) && table.rows.some((row) => passes(row, table)),
    );
    view?.finalize();
    view = null;
    if (width !== drawnWidth) room = undefined;
    drawnWidth = width;
    if (!hasData) {
      drawing.replaceChildren(element("p.quiet", {}, "No row passes the filters."));
      return;
    }
    const container = element("div", { "aria-hidden": "true" });
    const made = await drawn(section, chart, { theme: "page", width, font: pageFont(), passes, room });
    room = made.room;
    if (turn !== wanted) {
      made.view.finalize();
      return;
    }
    view = made.view;
    const found = (item) => factsOf(section, chart, item?.datum, passes);
    await view.renderer("svg").tooltip(tooltipOf(found)).initialize(container).runAsync();
    view.addEventListener("click", (_, item) => {
      const { title, facts, runs } = found(item) ?? { runs: [] };
      if (runs.length > 0) openTrace(report, title, facts, runs);
    });
    drawing.replaceChildren(container);
    drawing.dataset.drawn = "true";
  }
  const redraw = () => {
    const turn = ++wanted;
    return inTurn(() => draw(turn)).catch((error) => {
      drawing.replaceChildren(element("p.problem", {}, `This chart could not be drawn: ${error.message}`));
    });
  };

  const node = element(
    "figure.chart",
    { id, "data-chart": `${section.name}/${chart.name}` },
    element(
      "header",
      {},
      element("h3.minor", {}, chart.title),
      element(
        "span.actions",
        {},
        element(
          "button.small",
          {
            type: "button",
            "aria-label": `Download ${chart.title} as SVG`,
            onclick: () => saveAsSvg(section, chart, passes),
          },
          "SVG",
        ),
        element(
          "button.small",
          {
            type: "button",
            "aria-label": `Download ${chart.title} as PNG`,
            onclick: () => saveAsPng(section, chart, passes),
          },
          "PNG",
        ),
      ),
    ),
    drawing,
    element("figcaption", {}, chart.caption),
  );
  new ResizeObserver(() => {
    if (Math.floor(drawing.clientWidth) !== drawnWidth) redraw();
  }).observe(drawing);

  const show = (filter) => {
    passes = filter;
    redraw();
  };
  return { node, show };
}
