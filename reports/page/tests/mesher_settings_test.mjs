import assert from "node:assert/strict";
import { test } from "node:test";
import { distinctEnvironments, mesherSettings } from "../src/page/mesher_settings.mjs";

test("each version of a mesher has the settings of all its runs", () => {
  const runs = {
    "runs/a.json": { mesher: "tetgen", version: "1.5", settings: { switches: "pq" } },
    "runs/b.json": { mesher: "tetgen", version: "1.5", settings: { switches: "p", quiet: "yes" } },
    "runs/c.json": { mesher: "ccdt", version: "0.1", settings: {} },
  };
  assert.deepEqual(mesherSettings(runs), [
    { mesher: "ccdt", version: "0.1", runs: 1, settings: [] },
    {
      mesher: "tetgen",
      version: "1.5",
      runs: 2,
      settings: [
        { name: "switches", values: ["pq", "p"] },
        { name: "quiet", values: ["yes"] },
      ],
    },
  ]);
});

test("an environment is shown once for all experiments, whatever the load was", () => {
  const section = (title, cpu, load) => ({ title, environment: { cpu, load_average: load } });
  const found = distinctEnvironments([
    section("a", "one", 0.1),
    { title: "missing" },
    section("b", "two", 0.2),
    section("c", "one", 0.3),
  ]);
  assert.deepEqual(
    found.map(({ environment, loads, sections }) => [environment, loads, sections]),
    [
      [{ cpu: "one" }, [0.1, 0.3], ["a", "c"]],
      [{ cpu: "two" }, [0.2], ["b"]],
    ],
  );
});
