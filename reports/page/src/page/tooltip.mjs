import { element, list } from "./dom.mjs";
import { rowFacts, rowTitle } from "./rows.mjs";

const DISTANCE = 14;

let box = null;

function place(event) {
  const { innerWidth, innerHeight } = window;
  const { width, height } = box.getBoundingClientRect();
  const right = event.clientX + DISTANCE,
    below = event.clientY + DISTANCE;
  const x = right + width < innerWidth ? right : Math.max(4, event.clientX - DISTANCE - width);
  const y = below + height < innerHeight ? below : Math.max(4, event.clientY - DISTANCE - height);
  box.style.transform = `translate(${x}px, ${y}px)`;
}

/** The row of a table that a mark of a chart stands for. */
export function rowOf(section, datum) {
  const table = section.tables.find(({ name }) => name === datum?._table);
  const row = table?.rows[datum._row];
  return row ? { table, row } : null;
}

/** For Vega: shows what the row behind a mark says. */
export function tooltipOf(section) {
  return (_, event, item) => {
    const found = item ? rowOf(section, item.datum) : null;
    box ??= document.body.appendChild(element("div.tooltip", { role: "tooltip" }));
    box.hidden = !found;
    if (!found) return;
    const { table, row } = found;
    box.replaceChildren(
      element("strong", {}, rowTitle(table, row)),
      list("ul", rowFacts(table, row)) ?? "",
      row.runs.length > 0 ? element("span.quiet", {}, "Click to trace it to its runs") : "",
    );
    place(event);
  };
}
