/** What `ccdt report` has put into the page. */

function textOf(id) {
  return document.getElementById(id)?.textContent ?? null;
}

/** @returns {Promise<object|null>} JSON of schema ccdt.report/1, deflated where it is large */
export async function embeddedReport() {
  const text = textOf("ccdt-report");
  if (text !== null) return JSON.parse(text);
  const packed = textOf("ccdt-packed-report");
  return packed === null ? null : unpack(packed);
}

/** @returns {Object<string, object>} JSON of schema ccdt.mesh/1, by file */
export function embeddedMeshes() {
  return JSON.parse(textOf("ccdt-meshes") ?? "{}");
}

let files = null;

/** @returns {Promise<Object<string, unknown>>} all JSON files of the folder, by file; unpacked when first asked for */
export function embeddedFiles() {
  files ??= unpack(textOf("ccdt-files") ?? "");
  return files;
}

async function unpack(base64) {
  if (base64.trim() === "") return {};
  const bytes = Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}
