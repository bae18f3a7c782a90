import { csvOf } from "./csv.mjs";
import { element } from "./dom.mjs";
import { download } from "./downloads.mjs";
import { cellContent } from "./cells.mjs";
import { commonDecimals, counted, isEstimate, numberText, sortKey } from "./numbers.mjs";
import { rowTitle, saysUnit, sortedRows, STATUS, unitText } from "./rows.mjs";
import { traceButton, traceRow } from "./trace.mjs";

const ROWS_AT_FIRST = 12;
const MOST_ROWS_WITHOUT_BUTTON = 16;
const MOST_ROWS_AT_ONCE = 100; // longer tables have pages, so that the browser has little to lay out
const LONG_TITLE = 24;
const LONG_TEXT = 44; // characters; longer ones are wrapped

/**
 * The columns that are not empty. The reason for a missing value is shown beside the status. If every row is ok, the
 * status is left out.
 */
function shownColumns(table) {
  const hasStatus = table.columns.some(({ name }) => name === STATUS);
  const says = ({ name, kind }) => {
    if (kind === "note" && hasStatus) return false;
    if (name === STATUS) return table.rows.some((row) => row.values[STATUS] !== "ok" || notesOf(table, row).length > 0);
    return table.rows.some((row) => sortKey(row.values[name]) !== null);
  };
  return table.columns.filter(says).map((column) => {
    const cells = table.rows.map((row) => row.values[column.name]);
    const isLong = cells.some((cell) => typeof cell === "string" && cell.length > LONG_TEXT);
    return {
      ...column,
      isLong,
      isNumeric: cells.some((cell) => typeof cell === "number" || isEstimate(cell)),
      decimals: commonDecimals(cells),
    };
  });
}

function headCell(column, sorting, sort) {
  const state = sorting?.name === column.name ? (sorting.descending ? "descending" : "ascending") : "none";
  const unit = saysUnit(column) ? null : element("span.unit", {}, ` (${unitText(column.unit)})`);
  return element(
    (column.isNumeric ? "th.number" : "th") + (column.title.length > LONG_TITLE ? ".titled" : ""),
    { scope: "col", "aria-sort": state },
    element(
      "button.sort",
      { type: "button", "data-column": column.name, onclick: () => sort(column.name) },
      element("span", {}, column.title, unit),
      element("span.arrow", { "aria-hidden": "true" }, state === "descending" ? "↓" : state === "ascending" ? "↑" : ""),
    ),
  );
}

function hasRuns(table) {
  return table.rows.some((row) => row.runs.length > 0);
}

function notesOf(table, row) {
  return table.columns
    .filter(({ kind }) => kind === "note")
    .map(({ name }) => row.values[name])
    .filter(Boolean);
}

function statusContent(table, row) {
  return [
    element("span.status", { "data-status": row.values[STATUS] }, row.values[STATUS]),
    notesOf(table, row).map((note) => element("span.quiet", {}, ` ${note}`)),
  ];
}

function bodyRow(report, table, columns, row, isFolded) {
  const cells = columns.map(({ name, isNumeric, isLong, decimals, kind }, index) => {
    const content = kind === "note" && !row.values[name] ? null : cellContent(row.values[name], decimals);
    const isNote = kind === "note" || name === STATUS;
    const classes = (isNumeric ? ".number" : "") + (isLong ? ".long" : "") + (isNote ? ".note" : "");
    const body = name === STATUS ? statusContent(table, row) : content;
    return index === 0 ? element(`th${classes}`, { scope: "row" }, body) : element(`td${classes}`, {}, body);
  });
  const trace = traceButton(row.runs, rowTitle(table, row), () => traceRow(report, table, row));
  return element(isFolded ? "tr.folded" : "tr", {}, cells, hasRuns(table) ? element("td.trace-cell", {}, trace) : null);
}

/**
 * A table that can be sorted, filtered and traced.
 * @param {object} report
 * @param {object} section
 * @param {object} table
 * @returns {{node: Element, show: (passes: (row: object, table: object) => boolean) => void}}
 */
export function tableView(report, section, table) {
  const columns = shownColumns(table);
  let sorting = null,
    rows = table.rows,
    first = 0, // row that is shown
    isUnfolded = false;

  const head = element("thead"),
    body = element("tbody");
  const count = element("span.quiet", { "aria-live": "polite" });
  const unfold = element("button.small.unfold", { type: "button" });
  const save = element(
    "button.small",
    {
      type: "button",
      "aria-label": `Download ${table.title} as CSV`,
      onclick: () => download(`${section.name}-${table.name}.csv`, csvOf(table, rows), "text/csv"),
    },
    "CSV",
  );
  unfold.addEventListener("click", () => {
    isUnfolded = !isUnfolded;
    first = 0;
    draw();
  });

  const turn = (rowsAway) => {
    first = Math.min(Math.max(0, first + rowsAway), rows.length - 1);
    draw();
  };
  const back = element("button.small", { type: "button", onclick: () => turn(-MOST_ROWS_AT_ONCE) }, "Back");
  const next = element("button.small", { type: "button", onclick: () => turn(MOST_ROWS_AT_ONCE) }, "Next");
  const place = element("span.quiet", { "aria-live": "polite" });
  const pager = element("p.actions.pager", {}, back, place, next);

  const sort = (name) => {
    first = 0;
    const isSame = sorting?.name === name;
    sorting = isSame && sorting.descending ? null : { name, descending: isSame };
    draw();
    head.querySelector(`[data-column="${name}"]`).focus();
  };

  /** The rows that are in the page; folded ones are hidden, but they are printed and a search finds them. */
  function rowsInPage(mustFold) {
    const sorted = sortedRows(rows, sorting);
    if (rows.length <= MOST_ROWS_AT_ONCE) return sorted;
    return mustFold ? sorted.slice(0, ROWS_AT_FIRST) : sorted.slice(first, first + MOST_ROWS_AT_ONCE);
  }

  function showPager(isShown) {
    pager.hidden = !isShown;
    if (!isShown) return;
    const last = Math.min(first + MOST_ROWS_AT_ONCE, rows.length);
    place.textContent = ` Rows ${numberText(first + 1)} to ${numberText(last)} of ${numberText(rows.length)} `;
    back.disabled = first === 0;
    next.disabled = last === rows.length;
  }

  function draw() {
    const mustFold = rows.length > MOST_ROWS_WITHOUT_BUTTON && !isUnfolded;
    head.replaceChildren(
      element(
        "tr",
        {},
        columns.map((column) => headCell(column, sorting, sort)),
        hasRuns(table) ? element("th.trace-cell", { scope: "col" }, element("span.unseen", {}, "Runs")) : null,
      ),
    );
    body.replaceChildren(
      ...rowsInPage(mustFold).map((row, index) =>
        bodyRow(report, table, columns, row, mustFold && index >= ROWS_AT_FIRST),
      ),
    );
    count.textContent =
      rows.length === table.rows.length ? "" : `${rows.length} of ${counted(table.rows.length, "row")}`;
    showPager(!mustFold && rows.length > MOST_ROWS_AT_ONCE);
    unfold.hidden = rows.length <= MOST_ROWS_WITHOUT_BUTTON;
    unfold.textContent = mustFold ? `Show all ${counted(rows.length, "row")}` : "Show fewer rows";
    unfold.setAttribute("aria-expanded", String(!mustFold));
  }
  draw();

  const id = `${section.name}-${table.name}`;
  const node = element(
    "div.table",
    { id, "data-table": `${section.name}/${table.name}` },
    element("header", {}, element("h3.minor", {}, table.title), count, element("span.actions", {}, save)),
    element(
      "div.scroll",
      { tabindex: 0, role: "region", "aria-label": `${section.title}: ${table.title}` },
      element("table", {}, head, body),
    ),
    pager,
    unfold,
  );
  const show = (passes) => {
    rows = table.rows.filter((row) => passes(row, table));
    first = 0;
    draw();
  };
  return { node, show };
}
