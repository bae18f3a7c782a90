import { element } from "./dom.mjs";
import { distinctEnvironments, mesherSettings } from "./mesher_settings.mjs";
import { numberText } from "./numbers.mjs";

const MOST_VALUES = 6;

function definitions(pairs) {
  return element(
    "dl.facts",
    {},
    pairs.map(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );
}

function loadsText(loads) {
  const low = Math.min(...loads),
    high = Math.max(...loads);
  return low === high ? numberText(low, 2) : `${numberText(low, 2)} to ${numberText(high, 2)}`;
}

function environmentEntry({ environment, loads, sections }, isOnlyOne) {
  const { cpu, cores, system, compiler, flags, build_type: buildType, revision, libraries } = environment;
  return element(
    "div.environment",
    {},
    isOnlyOne ? null : element("p.label", {}, `Of ${sections.join("; ")}:`),
    definitions([
      ["Processor", cpu],
      ["Cores", numberText(cores)],
      ["Load at the start", loadsText(loads)],
      ["System", system],
      ["Compiler", compiler],
      ["Flags", element("code", {}, flags)],
      ["Build", buildType],
      ["Revision", element("code", {}, revision)],
      [
        "Libraries",
        Object.entries(libraries)
          .map(([name, version]) => `${name} ${version}`)
          .join(", "),
      ],
    ]),
  );
}

/** Many sizes are given as a range; the runs have each of them. */
function valuesText(values) {
  const numbers = values.map(Number);
  if (values.length > MOST_VALUES && numbers.every(Number.isFinite))
    return `${numberText(Math.min(...numbers))} to ${numberText(Math.max(...numbers))} (${values.length} values)`;
  return values.length <= MOST_VALUES
    ? values.join(", ")
    : `${values.slice(0, MOST_VALUES).join(", ")} and ${values.length - MOST_VALUES} more`;
}

function mesherRow({ mesher, version, runs, settings }) {
  const texts = settings.map(({ name, values }) =>
    element("div", {}, element("code", {}, name), ` ${valuesText(values)}`),
  );
  return element(
    "tr",
    {},
    element("th", { scope: "row" }, mesher || element("span.quiet", {}, "not recorded")),
    element("td", {}, version),
    element("td.number", {}, numberText(runs)),
    element("td", {}, texts),
  );
}

/** On what machine, with which programs and settings. */
export function environmentSection(report) {
  const environments = distinctEnvironments(report.experiments);
  const meshers = mesherSettings(report.runs);
  return element(
    "section.part",
    { id: "environment", "aria-labelledby": "environment-title" },
    element("h2", { id: "environment-title" }, "Environment and meshers"),
    environments.map((entry) => environmentEntry(entry, environments.length === 1)),
    element("h3.minor", {}, "Meshers and all settings of their runs"),
    element(
      "div.scroll",
      { tabindex: 0, role: "region", "aria-label": "Meshers" },
      element(
        "table.meshers",
        {},
        element(
          "thead",
          {},
          element(
            "tr",
            {},
            ["Mesher", "Version"].map((head) => element("th", { scope: "col" }, head)),
            element("th.number", { scope: "col" }, "Runs"),
            element("th", { scope: "col" }, "Settings, in the terms of the mesher"),
          ),
        ),
        element("tbody", {}, meshers.map(mesherRow)),
      ),
    ),
  );
}
