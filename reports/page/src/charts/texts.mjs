/**
 * The texts that a field has, each once, in the order of the tables.
 * @param {Object<string, object[]>} data  data sets by name
 * @param {string} field
 */
export function textsOf(data, field) {
  const values = new Set();
  for (const set of Object.values(data)) for (const datum of set) values.add(datum[field]);
  return [...values].filter((value) => typeof value === "string" && value !== "");
}
