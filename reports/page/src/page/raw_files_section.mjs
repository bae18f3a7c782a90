import { element } from "./dom.mjs";
import { baseName, download, jsonText } from "./downloads.mjs";
import { embeddedFiles } from "./embedded.mjs";
import { counted, numberText } from "./numbers.mjs";

const MOST_SHOWN = 200;

/** A file; one that is not in the page can only be opened. */
function fileEntry(file, content) {
  const save = () => download(baseName(file), jsonText(content), "application/json");
  return element(
    "li",
    {},
    element("a", { href: file }, file),
    content === undefined
      ? null
      : element("button.small", { type: "button", "aria-label": `Download ${file}`, onclick: save }, "Download"),
  );
}

function fileList(files, runs) {
  const names = [...new Set([...Object.keys(files), ...runs])].sort(
    (a, b) => a.split("/").length - b.split("/").length || a.localeCompare(b, "en", { numeric: true }),
  );
  const shown = element("ul.files");
  const more = element("p.quiet", { "aria-live": "polite" });
  const search = element("input", {
    type: "search",
    placeholder: "Part of a name",
    "aria-label": "Search the files",
    oninput: () => show(),
  });
  function show() {
    const found = names.filter((name) => name.includes(search.value.trim()));
    shown.replaceChildren(...found.slice(0, MOST_SHOWN).map((name) => fileEntry(name, files[name])));
    more.textContent =
      found.length > MOST_SHOWN
        ? `${numberText(found.length - MOST_SHOWN)} more: search for them.`
        : found.length === 0
          ? "No file has that name."
          : "";
  }
  show();
  return [search, shown, more];
}

/** All JSON from which the report was made, to download; unpacked on demand. */
export function rawFilesSection(report) {
  const save = (name, content) => download(name, jsonText(content), "application/json");
  const isSweep = report.experiments.some(({ name }) => name === "sweep");
  const place = element("div");
  const details = element("details.definitions", {}, element("summary", {}, "Each file"), place);
  details.addEventListener("toggle", async () => {
    if (!details.open || place.hasChildNodes()) return;
    const files = await embeddedFiles();
    place.append(
      element("p.quiet", {}, `${counted(Object.keys(files).length, "file")} in this page, and in its folder.`),
      ...fileList(files, Object.keys(report.runs)),
    );
  });
  return element(
    "section.part",
    { id: "files", "aria-labelledby": "files-title" },
    element("h2", { id: "files-title" }, "Raw data"),
    element(
      "p.lead",
      {},
      "Everything on this page was computed from JSON files; ccdt report makes the page from them again.",
      report.raw_runs === false
        ? " The records of the runs are not in this page, because there are many; each is a file in the folder runs."
        : "",
      isSweep ? " runs.csv and runs.jsonl have one line per run, for pandas and R." : "",
    ),
    isSweep
      ? element(
          "p.actions",
          {},
          ["runs.csv", "runs.jsonl"].map((file) => element("a.file", { href: file }, file)),
        )
      : null,
    element(
      "p.actions",
      {},
      element(
        "button",
        { type: "button", "data-download": "report", onclick: () => save("report.json", report) },
        "report.json",
      ),
      element(
        "button",
        { type: "button", "data-download": "all", onclick: async () => save("files.json", await embeddedFiles()) },
        "All files in one JSON",
      ),
    ),
    details,
  );
}
