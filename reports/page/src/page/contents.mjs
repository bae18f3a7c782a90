import { element } from "./dom.mjs";

/** Marks in the table of contents the section that is being read. */
function followReading(links) {
  const visible = new Set();
  const observer = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries)
        if (isIntersecting) visible.add(target.id);
        else visible.delete(target.id);
      const current = [...links.keys()].find((id) => visible.has(id));
      if (current === undefined) return;
      for (const [id, link] of links)
        if (id === current) link.setAttribute("aria-current", "true");
        else link.removeAttribute("aria-current");
    },
    { rootMargin: "-10% 0px -70% 0px" },
  );
  for (const id of links.keys()) observer.observe(document.getElementById(id));
}

/**
 * The table of contents: beside the page where there is room, otherwise folded at the top.
 * @param {Array<{id: string, title: string, note?: string}>} entries
 * @returns {{node: Element, follow: () => void}}  `follow` once the sections are in the page
 */
export function contents(entries) {
  const links = new Map(
    entries.map(({ id, title, note }) => [
      id,
      element("a", { href: `#${id}` }, title, note ? element("span.quiet", {}, ` ${note}`) : null),
    ]),
  );
  const items = () =>
    element(
      "ol",
      {},
      [...links.values()].map((link) => element("li", {}, link)),
    );
  const details = element("details", {}, element("summary", {}, "Contents"), items());
  const wide = matchMedia("(min-width: 72rem)");
  const unfold = () => {
    details.open = wide.matches;
  };
  wide.addEventListener("change", unfold);
  unfold();
  details.addEventListener("click", (event) => {
    if (event.target.closest("a") && !wide.matches) details.open = false;
  });
  return { node: element("nav.contents", { "aria-label": "Contents" }, details), follow: () => followReading(links) };
}
