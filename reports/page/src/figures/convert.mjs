import { execFile } from "node:child_process";
import { availableParallelism, cpus } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";

const PIXELS_PER_CSS_PIXEL = "4"; // 384 per printed inch

const run = promisify(execFile);

// A PDF contains its date; the same figures must be the same files.
const env = { SOURCE_DATE_EPOCH: "0", ...process.env };

/** What rsvg-convert is asked for. A CSS pixel is 1/96 inch, in the PDF as well. */
function jobsOf(folder, name) {
  const from = join(folder, `${name}.svg`);
  return [
    ["--format=pdf", "--dpi-x=96", "--dpi-y=96", `--output=${join(folder, `${name}.pdf`)}`, from],
    ["--format=png", `--zoom=${PIXELS_PER_CSS_PIXEL}`, `--output=${join(folder, `${name}.png`)}`, from],
  ];
}

/**
 * PDF and PNG of each NAME.svg of a folder.
 * @returns {Promise<string>} what failed, in one line; empty if nothing did
 */
export async function convertAll(folder, names) {
  const jobs = names.flatMap((name) => jobsOf(folder, name));
  const failed = new Set();
  const work = async () => {
    for (let job = jobs.shift(); job; job = jobs.shift()) {
      try {
        await run("rsvg-convert", job, { env });
      } catch (error) {
        if (error.code === "ENOENT") failed.add("there is no rsvg-convert (Debian: librsvg2-bin)");
        else
          failed.add(
            `rsvg-convert: ${
              String(error.stderr || error.message)
                .trim()
                .split("\n")[0]
            }`,
          );
        if (error.code === "ENOENT") jobs.length = 0;
      }
    }
  };
  await Promise.all(Array.from({ length: Math.min(availableParallelism?.() ?? cpus().length, 8) }, work));
  return failed.size === 0 ? "" : `No PDF or PNG of some figures: ${[...failed].join("; ")}`;
}
