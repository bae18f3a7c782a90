/**
 * The texts that a field has, each once, in the order of the tables.
 * @param {Object<string, object[]>} data  data sets by name
 * @param {string} field
 */
export function textsOf(data, field) {
  const values = Object.values(data)
    .flat()
    .map((datum) => datum[field]);
  return [...new Set(values.filter((value) => typeof value === "string" && value !== ""))];
}
