/**
 * Bundles the page and the program that draws the figures, or the tests.
 *
 *   node build.mjs page WORK OUT    OUT/page.html, OUT/render_figures.mjs, OUT/charts/*.json
 *   node build.mjs tests WORK       WORK/tests/unit_tests.mjs, compare_meshes.mjs, validate.mjs, write_page.mjs, and
 *                                   NAME_test.mjs of tests/browser
 *
 * WORK is a folder in which `npm ci` has been run: the libraries are there, not beside the sources. A file
 * WORK/page.d or WORK/tests.d tells the build system what went in.
 */
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const source = dirname(fileURLToPath(import.meta.url));
const charts = resolve(source, "../charts");

/** @returns {string[]} absolute paths of what esbuild has read, without the libraries */
function readFiles(...results) {
  return results
    .flatMap((result) => Object.keys(result.metafile.inputs))
    .map((file) => resolve(source, file))
    .filter((file) => !file.includes("node_modules"));
}

/** As `make` and `ninja` read it. */
function writeDependencies(file, target, sources) {
  const escaped = [...new Set(sources)].sort().map((path) => path.replaceAll(" ", "\\ "));
  writeFileSync(file, `${target}: ${escaped.join(" ")}\n`);
}

function fill(template, places) {
  return Object.entries(places).reduce((text, [place, content]) => {
    if (!text.includes(place)) throw new Error(`the template has no place ${place}`);
    return text.replace(place, () => content);
  }, template);
}

async function buildPage(esbuild, common, work, out) {
  const browser = {
    ...common,
    platform: "browser",
    target: "es2022",
    minify: true,
    write: false,
    legalComments: "none",
  };
  const script = await esbuild.build({ ...browser, entryPoints: ["src/page/page.mjs"], format: "iife" });
  const style = await esbuild.build({ ...browser, entryPoints: ["src/style/page.css"] });
  const template = join(source, "src/page/page.html");
  const page = fill(readFileSync(template, "utf8"), {
    "/* style */": style.outputFiles[0].text.trim(),
    "/* script */": script.outputFiles[0].text.trim(),
  });

  // Without canvas and network: the browser's version of the libraries needs none of node's packages for them.
  const figures = await esbuild.build({
    ...common,
    entryPoints: ["src/figures/render_figures.mjs"],
    outfile: join(out, "render_figures.mjs"),
    platform: "node",
    conditions: ["browser"],
    mainFields: ["module", "main"],
    format: "esm",
    target: "node18",
    minify: true,
    legalComments: "none",
  });

  rmSync(join(out, "charts"), { recursive: true, force: true });
  mkdirSync(join(out, "charts"), { recursive: true });
  const chartFiles = readdirSync(charts).filter((name) => name.endsWith(".json"));
  for (const name of chartFiles) copyFileSync(join(charts, name), join(out, "charts", name));
  writeFileSync(join(out, "page.html"), page);
  const inputs = [template, charts, ...chartFiles.map((name) => join(charts, name))];
  writeDependencies(join(work, "page.d"), join(out, "page.html"), [...inputs, ...readFiles(script, style, figures)]);
}

function testsIn(folder) {
  return readdirSync(join(source, folder), { withFileTypes: true })
    .filter((entry) => entry.isFile() && entry.name.endsWith("_test.mjs"))
    .map((entry) => `./${folder}/${entry.name}`);
}

/** The unit tests together are one program; what is run on reports is in programs of its own. */
async function buildTests(esbuild, common, work) {
  const out = join(work, "tests");
  rmSync(out, { recursive: true, force: true });
  const node = {
    ...common,
    platform: "node",
    format: "esm",
    target: "node18",
    packages: "external",
    sourcemap: "inline",
    sourcesContent: false,
  };
  const unit = await esbuild.build({
    ...node,
    stdin: {
      contents: testsIn("tests")
        .map((file) => `import "${file}";`)
        .join("\n"),
      resolveDir: source,
    },
    outfile: join(out, "unit_tests.mjs"),
  });
  const programs = await esbuild.build({
    ...node,
    entryPoints: [...testsIn("tests/browser"), "./tests/compare_meshes.mjs", "./tests/validate.mjs", "./tests/fixture/write_page.mjs"],
    outdir: out,
    entryNames: "[name]",
    outExtension: { ".js": ".mjs" },
  });
  writeFileSync(join(out, "built"), "");
  const folders = [join(source, "tests"), join(source, "tests/browser")];
  writeDependencies(join(work, "tests.d"), join(out, "built"), [...folders, ...readFiles(unit, programs)]);
}

const [what, workArgument, outArgument] = process.argv.slice(2);
const work = resolve(workArgument);
const esbuild = createRequire(join(work, "package.json"))("esbuild");
const common = {
  absWorkingDir: source,
  bundle: true,
  metafile: true,
  logLevel: "warning",
  nodePaths: [join(work, "node_modules")],
  loader: { ".json": "json" },
};
if (what === "page") await buildPage(esbuild, common, work, resolve(outArgument));
else await buildTests(esbuild, common, work);
