import { commandLine } from "./copy.mjs";
import { element, list } from "./dom.mjs";
import { baseName, download, jsonText } from "./downloads.mjs";
import { embeddedFiles } from "./embedded.mjs";
import { counted } from "./numbers.mjs";
import { rowFacts, rowTitle } from "./rows.mjs";

/** The raw JSON of a run, shown when it is asked for. */
function rawJson(file) {
  const text = element("pre", { tabindex: 0 }, "…");
  const save = element("button.small", { type: "button" }, "Download");
  const details = element(
    "details.raw",
    {},
    element("summary", {}, "Raw JSON"),
    element("p.actions", {}, save, element("a", { href: file }, file)),
    text,
  );
  const content = async () => {
    const found = (await embeddedFiles())[file];
    return found === undefined ? null : jsonText(found);
  };
  details.addEventListener("toggle", async () => {
    const isHere = (await content()) !== null;
    save.hidden = !isHere;
    if (details.open) text.textContent = (await content()) ?? `This file is not in the page, but in its folder: ${file}`;
  });
  save.addEventListener("click", async () => {
    const json = await content();
    if (json !== null) download(baseName(file), json, "application/json");
  });
  return details;
}

function settingsText(settings) {
  return Object.entries(settings)
    .map(([name, value]) => `${name} ${value}`)
    .join(", ");
}

function runEntry(file, run, open) {
  if (!run) return element("li", {}, element("p", {}, element("code", {}, file), ": not in this report"));
  const settings = settingsText(run.settings);
  return element(
    "li",
    {},
    element(
      "details.run",
      { open, "data-run": file },
      element(
        "summary",
        {},
        element("code", {}, baseName(file)),
        " ",
        element("span.status", { "data-status": run.status }, run.status),
        " ",
        element("span.quiet", {}, `${run.mesher} ${run.version}`),
      ),
      element("p.label", {}, "To repeat it, run this command in the folder of the report:"),
      commandLine(run.command),
      settings ? element("p.quiet", {}, `Settings: ${settings}`) : null,
      rawJson(file),
    ),
  );
}

const MOST_RUNS = 100; // in one list

let dialog = null;

function openDialog(title, ...content) {
  dialog?.remove();
  const close = element("button.small", { type: "button", "aria-label": "Close" }, "Close");
  dialog = element(
    "dialog.trace",
    { "aria-labelledby": "trace-title" },
    element("header", {}, element("h2", { id: "trace-title" }, title), close),
    ...content.filter(Boolean),
  );
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
}

/**
 * Shows the source of a number: each run, the command that repeats it, and its raw JSON.
 * @param {object} report
 * @param {string} title    what the number measures
 * @param {string[]} facts  other facts about it
 * @param {string[]} files  of the runs
 */
export function openTrace(report, title, facts, files) {
  openDialog(
    title,
    list("ul.facts", facts),
    element("p.label", {}, `It is based on ${counted(files.length, "run")}:`),
    element(
      "ol.runs",
      {},
      files.slice(0, MOST_RUNS).map((file, index) => runEntry(file, report.runs[file], index === 0)),
    ),
    files.length > MOST_RUNS ? element("p.quiet", {}, `and ${counted(files.length - MOST_RUNS, "more run")}.`) : null,
  );
}

/** Shows the runs behind a row of a table. */
export function traceRow(report, table, row) {
  openTrace(report, rowTitle(table, row) || table.title, rowFacts(table, row), row.runs);
}

/** The control that opens the runs of a row or a measure. */
export function traceButton(files, what, open) {
  if (files.length === 0) return null;
  return element(
    "button.small.trace",
    { type: "button", "data-trace": "", onclick: open },
    counted(files.length, "run"),
    element("span.unseen", {}, ` of ${what}`),
  );
}
