import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import config from "../../charts/config.json" with { type: "json" };
import { compiled } from "../src/charts/draw.mjs";
import { measureWithoutCanvas } from "../src/charts/measure_text.mjs";
import { PRINT_WIDTH } from "../src/charts/print.mjs";
import { completeSpec } from "../src/charts/spec.mjs";
import { textSize } from "../src/charts/text_size.mjs";
import { chartSvg } from "../src/figures/chart_svg.mjs";
import { madeUpReport } from "./fixture/report.mjs";

/** What a journal asks of a figure, of every figure. */

measureWithoutCanvas();
const { report } = madeUpReport(join(process.env.CCDT_REPORTS, "charts"));
const all = report.experiments.flatMap((section) => section.charts.map((chart) => ({ section, chart })));

const UNIT = /\((s|µs|degrees|%|mm|dimensionless|% per [^)]+)\)$|^number of |^time of [^(]*\(s\)$/;

/** The axes of numbers, each with its scale. Lines of a grid are axes as well, but have no labels. */
function numberAxes(spec, around = new Map()) {
  const scales = new Map([...around, ...(spec.scales ?? []).map((scale) => [scale.name, scale])]);
  const own = (spec.axes ?? []).filter(({ labels }) => labels !== false).map((axis) => ({ axis, scale: scales.get(axis.scale) }));
  return [
    ...own.filter(({ scale }) => ["linear", "log"].includes(scale.type)),
    ...(spec.marks ?? []).flatMap((part) => numberAxes(part, scales)),
  ];
}

/** Charts of several measures have the name of each below its axis. */
function namesBelowAxes({ facet }) {
  const { orient, labelExpr = "" } = facet?.header ?? {};
  return orient === "bottom" ? [...labelExpr.matchAll(/: '([^']*)'/g)].map(([, name]) => name) : [];
}

/** A long title has several lines. */
const titleOf = ({ axis: { title } }) => [title ?? []].flat().join(" ");

function titlesOf(chart, axes) {
  const below = namesBelowAxes(chart.spec);
  return axes.flatMap((one) => (titleOf(one) ? [titleOf(one)] : below.length > 0 ? below : ["without a title"]));
}

/** Where the scale of an axis starts, as far as its specification says. */
const startOf = ({ domain, domainMin }) => (Array.isArray(domain) ? domain[0] : domainMin);

const texts = (svg) => [...svg.matchAll(/<text[^>]*>([^<]*)</g)].map(([, text]) => text);
const attributes = (svg, name) => [...new Set([...svg.matchAll(new RegExp(` ${name}="([^"]*)"`, "g"))].map(([, value]) => value))];

/** The marks whose height or level is a share of a bin. */
function isHistogram(spec) {
  const { mark } = spec;
  const isBinned = mark?.type === "bar" ? spec.encoding.x?.field === "low" : mark?.interpolate?.startsWith("step-after");
  return Boolean(isBinned && spec.encoding?.x?.field === "low") || [spec.spec, ...(spec.layer ?? [])].some((part) => part && isHistogram(part));
}

function hasEqualBins(section, chart) {
  const tables = section.tables.filter(({ name }) => chart.tables.includes(name));
  const widths = tables.flatMap(({ rows }) => rows.map(({ values }) => values.high - values.low));
  return Math.max(...widths) < 1.001 * Math.min(...widths);
}

for (const { section, chart } of all) {
  const name = `${section.name}-${chart.name}`;
  const axes = numberAxes(compiled(completeSpec(section, chart, { theme: "light" }), textSize("light")));

  test(`${name} has units on its axes`, () => {
    for (const title of titlesOf(chart, axes)) assert.match(title, UNIT);
  });

  test(`${name} has linear axes that start at zero, or at 1 for r, which is never less`, () => {
    for (const one of axes.filter(({ scale }) => scale.type === "linear"))
      assert.equal(startOf(one.scale), titleOf(one).startsWith("r (") ? 1 : 0, titleOf(one));
  });

  test(`${name} has equal bins or a density, if it is a histogram`, () => {
    if (!isHistogram(chart.spec) || hasEqualBins(section, chart)) return;
    assert.ok(titlesOf(chart, axes).some((title) => /^density \(% per /.test(title)));
  });

  test(`${name} is as wide as a column, with one font in one size, plain numbers, and no cut text`, async () => {
    const svg = await chartSvg(section, chart);
    const width = Number(/ width="([\d.]+)"/.exec(svg)[1]);
    assert.ok(width <= PRINT_WIDTH && width > PRINT_WIDTH - 4, `${width}`);
    assert.deepEqual(attributes(svg, "font-family").map((family) => family.replaceAll("&apos;", "'")), [config.font]);
    assert.equal(attributes(svg, "font-size").length, 1);
    assert.equal(Number.parseFloat(attributes(svg, "font-size")[0]).toFixed(2), ((config.fontPoints * 96) / 72).toFixed(2));
    assert.ok(attributes(svg, "font-weight").every((weight) => weight === "normal"));
    for (const text of texts(svg)) {
      assert.doesNotMatch(text, /…/);
      assert.doesNotMatch(text, /^[\d.,]+(e[-+]?\d+|[kMGmµn])$/);
    }
  });
}

test("the histogram of r is seen as a histogram of unequal bins", () => {
  const { section, chart } = all.find((one) => one.section.name === "fig9" && one.chart.name === "r");
  assert.ok(isHistogram(chart.spec) && !hasEqualBins(section, chart));
});

test("long names of series are not cut, and the figure is not wider", async () => {
  const long = "the paper's whole algorithm, face by face in the uniform grid, with visibility tests of every candidate";
  const names = { fig8: "with check", table1: "CDT without", fig9: "tetgen" };
  for (const { section, chart } of all.filter((one) => names[one.section.name])) {
    const renamed = JSON.parse(JSON.stringify(section).replaceAll(`"${names[section.name]}"`, JSON.stringify(long)));
    const svg = await chartSvg(renamed, chart);
    assert.doesNotMatch(svg, /…/);
    assert.ok(Number(/ width="([\d.]+)"/.exec(svg)[1]) <= PRINT_WIDTH, `${section.name}-${chart.name}`);
  }
});

/** CIE lightness of a color, from 0 (black) to 100 (white): what remains of it in gray. */
function lightness(color) {
  const [r, g, b] = [1, 3, 5]
    .map((at) => parseInt(color.slice(at, at + 2), 16) / 255)
    .map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
  return 116 * Math.cbrt(0.2126 * r + 0.7152 * g + 0.0722 * b) - 16;
}

test("series differ in gray: by lightness, shape and dashes", () => {
  const levels = Object.values(config.palettes.light).map(lightness).sort((a, b) => a - b);
  levels.slice(1).forEach((level, index) => assert.ok(level - levels[index] > 5, `${level} after ${levels[index]}`));
  assert.ok(levels.at(-1) < 80, "the lightest line must be seen on white");
  for (const what of ["color", "shape", "dash"])
    assert.equal(new Set(config.series.map((one) => String(one[what]))).size, config.series.length, what);
});
