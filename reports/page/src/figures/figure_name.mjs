/**
 * The name of a figure's file: its experiment and what it shows, "fig7-stepping-pole".
 * @param {string} experiment
 * @param {string} shown  in words
 */
export function figureName(experiment, shown) {
  const words = shown.toLowerCase().match(/[a-z0-9]+/g) ?? [];
  return [experiment, ...words].join("-");
}

/**
 * The same for several figures of an experiment; those that show the same are numbered.
 * @param {string[]} shown
 * @returns {string[]}
 */
export function figureNames(experiment, shown) {
  const counts = new Map();
  return shown.map((words) => {
    const name = figureName(experiment, words);
    const count = (counts.get(name) ?? 0) + 1;
    counts.set(name, count);
    return count === 1 ? name : `${name}-${count}`;
  });
}
