import { chartView } from "./chart_view.mjs";
import { commandLine } from "./copy.mjs";
import { csvOf } from "./csv.mjs";
import { element, list } from "./dom.mjs";
import { baseName, download } from "./downloads.mjs";
import { filterControls } from "./filter_controls.mjs";
import { passes } from "./filters.mjs";
import { meshPictures } from "./mesh_pictures.mjs";
import { counted, numberText } from "./numbers.mjs";
import { tableView } from "./table_view.mjs";

const MOST_FINDINGS = 8;
const FINDINGS_AT_FIRST = 6;
const FILTERED_AFTER = 150; // milliseconds without another change; then charts are drawn anew

function limitsText(limits) {
  const parts = [];
  if (limits?.seconds > 0) parts.push(`${numberText(limits.seconds)} s`);
  if (limits?.memory_bytes > 0) parts.push(`${numberText(limits.memory_bytes / 2 ** 30)} GiB`);
  return parts.length > 0 ? `limits of a run: ${parts.join(", ")}` : "";
}

const FEWEST_FOR_INTERVAL = 6; // as in bench/run/median_interval.h

/** How it was measured, in a line. */
function circumstances(section) {
  const { scale, tetrahedra, runs, confidence } = section;
  return [
    scale ? `scale ${scale}` : "",
    tetrahedra ? `about ${numberText(tetrahedra)} tetrahedra per model` : "",
    runs ? `${counted(runs, "counted run")} per case` : "",
    confidence && runs >= FEWEST_FOR_INTERVAL ? `${numberText(100 * confidence)}% intervals` : "",
    limitsText(section.limits),
  ]
    .filter(Boolean)
    .join(" · ");
}

function missingSection(section) {
  return [
    element(
      "p.problem",
      { "data-missing": section.name },
      `This experiment is missing: ${(section.reason || "it has not been measured").replace(/\.?$/, ".")}`,
    ),
    element("p.label", {}, "This command makes it:"),
    commandLine(section.command),
  ];
}

function dataTables(section) {
  const tables = section.tables.filter((table) => table.data);
  if (tables.length === 0 && section.raw_files.length === 0) return null;
  const buttons = tables.map((table) =>
    element(
      "button.small",
      { type: "button", onclick: () => download(`${section.name}-${table.name}.csv`, csvOf(table), "text/csv") },
      `${table.title} (CSV)`,
    ),
  );
  const files = section.raw_files.map((file) => element("a.file", { href: file }, baseName(file)));
  return element("p.actions.data", {}, element("span.quiet", {}, "Data: "), buttons, files);
}

/** The first findings, and the rest on demand. */
function findings({ findings: all }) {
  if (all.length <= MOST_FINDINGS) return list("ul.findings", all);
  const rest = all.length - FINDINGS_AT_FIRST;
  return [
    list("ul.findings", all.slice(0, FINDINGS_AT_FIRST)),
    element(
      "details.definitions",
      {},
      element("summary", {}, `${rest} more findings`),
      list("ul", all.slice(FINDINGS_AT_FIRST)),
    ),
  ];
}

/** Charts in the order that they state; charts without one keep their order. */
function inOrder(charts) {
  const rank = (chart) => chart.spec.usermeta?.order ?? 0;
  return [...charts].sort((a, b) => rank(a) - rank(b));
}

function results(report, section) {
  const charts = inOrder(section.charts).map((chart) => chartView(report, section, chart));
  const tables = section.tables
    .filter((table) => !table.data && table.rows.length > 0)
    .map((table) => tableView(report, section, table));
  let pending = 0;
  const controls = filterControls(section, (state) => {
    const filter = (row, table) => passes(state, row, table);
    for (const table of tables) table.show(filter);
    clearTimeout(pending);
    pending = setTimeout(() => {
      for (const chart of charts) chart.show(filter);
    }, FILTERED_AFTER);
  });
  return [controls, charts.map(({ node }) => node), tables.map(({ node }) => node), dataTables(section)];
}

function failure(section) {
  return section.status === "failed"
    ? element("p.problem", {}, section.reason || "ccdt itself failed here, or gave a wrong result; see below.")
    : null;
}

/**
 * One experiment: what it found, its pictures, its charts, its tables.
 * @param {object} report
 * @param {object} section
 * @param {Object<string, object>} keptMeshes  JSON of schema ccdt.mesh/1, by file
 */
export function experimentSection(report, section, keptMeshes) {
  const id = `experiment-${section.name}`;
  const head = [
    element("h2", { id: `${id}-title` }, section.title),
    element(
      "p.lead",
      {},
      [section.section ? `Section ${section.section} of the paper` : "", circumstances(section)]
        .filter(Boolean)
        .join(" · "),
    ),
  ];
  const body =
    section.status === "missing"
      ? missingSection(section)
      : [
          failure(section),
          findings(section),
          section.problems.length > 0
            ? element("div.problem", {}, element("h3.minor", {}, "Problems"), list("ul", section.problems))
            : null,
          meshPictures(section, keptMeshes),
          section.meshes.length > 0
            ? element("p", {}, element("a", { href: "#meshes" }, "Turn and cut its meshes"))
            : null,
          results(report, section),
          section.definitions.length > 0
            ? element(
                "details.definitions",
                {},
                element("summary", {}, "Definitions"),
                list("ul", section.definitions),
              )
            : null,
          element(
            "details.definitions",
            {},
            element("summary", {}, "Repeat this experiment"),
            commandLine(section.command),
          ),
        ];
  return element(
    "section.part",
    { id, "data-experiment": section.name, "data-status": section.status, "aria-labelledby": `${id}-title` },
    head,
    body,
  );
}
