import { mountViewer } from "../viewer/viewer.mjs";
import { contents } from "./contents.mjs";
import { append, element } from "./dom.mjs";
import { embeddedMeshes, embeddedReport } from "./embedded.mjs";
import { environmentSection } from "./environment_section.mjs";
import { experimentSection } from "./experiment_section.mjs";
import { meshSection } from "./mesh_section.mjs";
import { counted } from "./numbers.mjs";
import { rawFilesSection } from "./raw_files_section.mjs";
import { defineChartColors, themeSwitch } from "./theme.mjs";
import { verdictCounts, verdictSection } from "./verdicts.mjs";

/** "3 experiments and 120 runs", "2,000 cases and 10,000 runs" */
function counts(report, made) {
  const sweeps = made.filter(({ name }) => name === "sweep");
  const cases = sweeps.reduce((sum, { tables }) => sum + tables.find(({ name }) => name === "cases").rows.length, 0);
  return [
    made.length > sweeps.length ? counted(made.length - sweeps.length, "experiment") : "",
    sweeps.length > 0 ? counted(cases, "case") : "",
    counted(Object.keys(report.runs).length, "run"),
  ]
    .filter(Boolean)
    .join(" and ");
}

function summary(report) {
  const made = report.experiments.filter(({ status }) => status !== "missing");
  const processors = [...new Set(made.map(({ environment }) => environment?.cpu).filter(Boolean))];
  const claims = report.claims.length > 0 ? `${counted(report.claims.length, "claim")} of the paper, tested by ` : "";
  return (
    `${claims}${counts(report, made)}` +
    `${processors.length > 0 ? ` on ${processors.join(" and ")}` : ""}.`
  );
}

function header(report) {
  return element(
    "header.page",
    {},
    element("div.title", {}, element("h1", {}, report.title), themeSwitch()),
    element("p.summary", {}, summary(report)),
    element("p.counts", {}, verdictCounts(report)),
  );
}

function footer() {
  return element(
    "footer.page",
    {},
    element(
      "p",
      {},
      "The paper: Y.-J. Yang, J.-H. Yong, J.-G. Sun, ",
      element(
        "cite",
        {},
        "An algorithm for tetrahedral mesh generation based on conforming constrained Delaunay tetrahedralization",
      ),
      ", Computers & Graphics 29 (2005). This page is one file and needs no network.",
    ),
  );
}

function sectionTitles(report) {
  return report.experiments.map(({ name, title, status }) => ({
    id: `experiment-${name}`,
    title,
    note: status === "ok" ? "" : `(${status})`,
  }));
}

function show(report) {
  document.title = report.title;
  const keptMeshes = embeddedMeshes();
  const meshes = meshSection(report, keptMeshes, mountViewer);
  const parts = [
    verdictSection(report),
    ...report.experiments.map((section) => experimentSection(report, section, keptMeshes)),
    meshes,
    environmentSection(report),
    rawFilesSection(report),
  ];
  const { node, follow } = contents([
    ...(report.claims.length > 0 ? [{ id: "verdicts", title: "The paper's claims" }] : []),
    ...sectionTitles(report),
    ...(meshes ? [{ id: "meshes", title: "Meshes" }] : []),
    { id: "environment", title: "Environment and meshers" },
    { id: "files", title: "Raw data" },
  ]);
  append(document.getElementById("page"), [
    element("a.skip", { href: "#main" }, "Skip to the content"),
    header(report),
    element("div.columns", {}, node, element("main", { id: "main" }, parts)),
    footer(),
  ]);
  follow();
}

defineChartColors();
embeddedReport().then((report) => {
  if (report) return show(report);
  append(
    document.getElementById("page"),
    element("p", {}, "This page contains no report: ccdt report adds one."),
  );
});
