let queue = Promise.resolve();

/**
 * Does pieces of work one after another, so that the page stays responsive.
 * @param {() => Promise<void>} work
 * @returns {Promise<void>} settled as the work
 */
export function inTurn(work) {
  const done = queue.then(() => new Promise((resolve) => setTimeout(resolve))).then(work);
  queue = done.catch(() => {});
  return done;
}
