import { cellContent } from "./cells.mjs";
import { element } from "./dom.mjs";
import { cellText, counted } from "./numbers.mjs";
import { openTrace, traceButton } from "./trace.mjs";

const VERDICTS = ["confirmed", "confirmed with a reservation", "refuted", "not testable here"];
/** The words for verdicts that people read differently from the names in JSON. */
const WORDS = {
  "confirmed with a reservation": "partly confirmed",
  "not testable here": "not testable at this scale",
};
const SIGNS = { confirmed: "✓", "confirmed with a reservation": "≈", refuted: "✕", "not testable here": "–" };

const wordsOf = (verdict) => WORDS[verdict] ?? verdict;

/** The verdict in words, with a sign and a color beside them. */
function badge(verdict, text = wordsOf(verdict)) {
  return element(
    "span.badge",
    { "data-verdict": verdict },
    element("span", { "aria-hidden": "true" }, SIGNS[verdict] ?? "?"),
    ` ${text}`,
  );
}

const HOLDS = new Map([
  [true, "✓ holds"],
  [false, "✕ does not hold"],
  [null, "undecided"],
]);

/** Where a measure was taken: its table, or the section if the table is not shown. */
function linkTo(report, { experiment, table }) {
  const section = report.experiments.find(({ name }) => name === experiment);
  const isShown = section?.tables.some(({ name, data }) => name === table && !data);
  if (!section) return element("span", {}, experiment);
  return element(
    "a",
    { href: isShown ? `#${experiment}-${table}` : `#experiment-${experiment}` },
    isShown ? `${experiment}, ${table}` : experiment,
  );
}

function measureRow(report, claim, measure) {
  const facts = [
    claim.sentence,
    `Measured: ${cellText(measure.value)}`,
    measure.bound ? `Required: ${measure.bound}` : "",
  ].filter(Boolean);
  return element(
    "tr",
    {},
    element("th", { scope: "row" }, measure.what),
    element("td.number", {}, cellContent(measure.value)),
    element("td", {}, measure.bound),
    element("td.holds", { "data-holds": String(measure.holds) }, measure.bound ? HOLDS.get(measure.holds) : null),
    element("td", {}, linkTo(report, measure)),
    element(
      "td.trace-cell",
      {},
      traceButton(measure.runs, measure.what, () => openTrace(report, measure.what, facts, measure.runs)),
    ),
  );
}

const MOST_MEASURES_OPEN = 4;

function measures(report, claim) {
  if (claim.measured.length === 0) return null;
  const heads = ["Measured", "Value", "Required", "Result", "Where", "Runs"];
  const table = element(
    "div.scroll",
    { tabindex: 0, role: "region", "aria-label": `What was measured: ${claim.sentence}` },
    element(
      "table",
      {},
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          heads.map((head, index) => element(index === 1 ? "th.number" : "th", { scope: "col" }, head)),
        ),
      ),
      element(
        "tbody",
        {},
        claim.measured.map((measure) => measureRow(report, claim, measure)),
      ),
    ),
  );
  return element(
    "details.measures",
    { open: claim.measured.length <= MOST_MEASURES_OPEN },
    element("summary", {}, counted(claim.measured.length, "measure")),
    table,
  );
}

function claimEntry(report, claim) {
  const links = claim.experiments.map((name, index) => [
    index > 0 ? ", " : null,
    element("a", { href: `#experiment-${name}` }, name),
  ]);
  return element(
    "article.claim",
    { id: `claim-${claim.id}`, "data-claim": claim.id, "data-verdict": claim.verdict },
    element("header", {}, badge(claim.verdict), element("span.quiet", {}, `Section ${claim.section} of the paper`)),
    element("h3", {}, claim.sentence),
    element("p", {}, claim.reason, links.length > 0 ? element("span.quiet", {}, " Tested by ", links, ".") : null),
    measures(report, claim),
  );
}

/** How many claims got which verdict, each a badge. */
export function verdictCounts(report) {
  return VERDICTS.map((verdict) => ({
    verdict,
    count: report.claims.filter((claim) => claim.verdict === verdict).length,
  }))
    .filter(({ count }) => count > 0)
    .map(({ verdict, count }) => badge(verdict, `${count} ${wordsOf(verdict)}`));
}

/** The section of the verdicts; none without claims. */
export function verdictSection(report) {
  if (report.claims.length === 0) return null;
  return element(
    "section.part",
    { id: "verdicts", "aria-labelledby": "verdicts-title" },
    element("h2", { id: "verdicts-title" }, "The paper's claims"),
    element(
      "p.lead",
      {},
      "Each claim of the paper, with its measurements here and the verdict. ",
      "Verdicts are computed from the measurements. ",
      "The models are ours: the paper gives neither the geometry nor the sizes of its three parts.",
    ),
    report.claims.map((claim) => claimEntry(report, claim)),
  );
}
