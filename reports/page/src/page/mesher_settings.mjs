/**
 * What the runs say of each mesher: its version and its settings, each with all values that occurred.
 * @param {Object<string, {mesher: string, version: string, settings: Object<string, string>}>} runs
 * @returns {Array<{mesher: string, version: string, runs: number, settings: Array<{name: string, values: string[]}>}>}
 */
export function mesherSettings(runs) {
  const meshers = new Map();
  for (const { mesher, version, settings } of Object.values(runs)) {
    const key = JSON.stringify([mesher, version]);
    if (!meshers.has(key)) meshers.set(key, { mesher, version, runs: 0, settings: new Map() });
    const entry = meshers.get(key);
    ++entry.runs;
    for (const [name, value] of Object.entries(settings)) {
      if (!entry.settings.has(name)) entry.settings.set(name, new Set());
      entry.settings.get(name).add(String(value));
    }
  }
  return [...meshers.values()]
    .map(({ settings, ...entry }) => ({
      ...entry,
      settings: [...settings].map(([name, values]) => ({ name, values: [...values] })),
    }))
    .sort((a, b) => a.mesher.localeCompare(b.mesher) || a.version.localeCompare(b.version));
}

/**
 * The environments of the sections, each once, with the sections that were measured in it. The load of the
 * machine is not compared.
 * @returns {Array<{environment: object, loads: number[], sections: string[]}>}
 */
export function distinctEnvironments(sections) {
  const found = new Map();
  for (const { title, environment } of sections) {
    if (!environment) continue;
    const { load_average: load, ...rest } = environment;
    const key = JSON.stringify(rest);
    if (!found.has(key)) found.set(key, { environment: rest, loads: [], sections: [] });
    found.get(key).loads.push(load);
    found.get(key).sections.push(title);
  }
  return [...found.values()];
}
