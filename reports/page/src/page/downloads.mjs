import { element } from "./dom.mjs";

/** Offers something made in the page as a file. */
export function download(name, content, type) {
  const address =
    content instanceof Blob ? URL.createObjectURL(content) : URL.createObjectURL(new Blob([content], { type }));
  const link = element("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** The last part of a path, for the name of a file. */
export function baseName(path) {
  return path.split("/").at(-1);
}

/** JSON as a person reads it. */
export function jsonText(value) {
  return typeof value === "string" ? value : `${JSON.stringify(value, null, 2)}\n`;
}
