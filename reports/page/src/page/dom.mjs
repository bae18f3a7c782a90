/**
 * An element. Texts never become markup.
 * @param {string} name  its tag, with classes after dots: "p.note"
 * @param {Object<string, unknown>} attributes  undefined, null and false: left out; a function: listens to "on..."
 * @param {...(Node|string|number|null|undefined|Array)} children
 */
export function element(name, attributes = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const made = document.createElement(tag);
  if (classes.length > 0) made.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === "function") made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? "" : String(value));
  }
  append(made, children);
  return made;
}

/** Children in nested arrays; nothing is left out. */
export function append(parent, children) {
  for (const child of [children].flat(Infinity)) {
    if (child !== undefined && child !== null && child !== false && child !== "") parent.append(child);
  }
}

/** A list with bullets; nothing for none. */
export function list(name, texts, attributes = {}) {
  return texts.length === 0
    ? null
    : element(
        name,
        attributes,
        texts.map((text) => element("li", {}, text)),
      );
}
