import { element, list } from "./dom.mjs";

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

/**
 * For Vega: shows what is known of a mark.
 * @param {(item: object) => {title: string, facts: string[], runs: string[]}|null} factsOf
 */
export function tooltipOf(factsOf) {
  return (_, event, item) => {
    const found = item ? factsOf(item) : null;
    box ??= document.body.appendChild(element("div.tooltip", { role: "tooltip" }));
    box.hidden = !found;
    if (!found) return;
    box.replaceChildren(
      element("strong", {}, found.title),
      list("ul", found.facts) ?? "",
      found.runs.length > 0 ? element("span.quiet", {}, "Click to trace it to its runs") : "",
    );
    place(event);
  };
}
