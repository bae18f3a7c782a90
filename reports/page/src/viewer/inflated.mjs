/**
 * Bytes that were deflated (zlib format) and written in base64, in a browser as in node.
 * @param {string} base64
 * @returns {Promise<ArrayBuffer>}
 */
export async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}
