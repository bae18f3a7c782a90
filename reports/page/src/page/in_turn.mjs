let queue = Promise.resolve();

/**
 * Does pieces of work one after another, so that the page stays responsive.
 * @param {() => Promise<void>} work
 * @returns {Promise<void>} settles as that of `work` does
 */
export function inTurn(work) {
  const done = queue.then(() => new Promise((resolve) => setTimeout(resolve))).then(work);
  queue = done.catch(() => {});
  return done;
}
