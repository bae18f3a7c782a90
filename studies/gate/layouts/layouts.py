#!/usr/bin/env python3
"""How much does the layout of a program change its speed, and what does `ccdt gate` make of it? An experiment.

Each part continues an earlier call:
  measure    links layouts of one source, runs them in turns, and writes layouts.json and layouts.md
  resample   simulates gates from these times, and writes resample.json and resample.md
  gates      runs gates of two builds, and gates that rebuild them, and writes gates.json and gates.md

Examples:
  studies/gate/layouts/layouts.py build/layouts measure
  studies/gate/layouts/layouts.py build/layouts measure --program ccdt --build build/release
  studies/gate/layouts/layouts.py build/layouts resample --noise 0.3
  studies/gate/layouts/layouts.py build/layouts gates --gates 0 40 40 0 40 40 -- --benchmark_min_time=0.02
"""

import argparse
import json
import math
import random
import shlex
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True  # beside the source
sys.path.append(str(Path(__file__).resolve().parent.parent))
import random_effects as effects
import simulated_gates as simulated
from programs import Ccdt, Kernels
from real_gates import KINDS, run_gates
from study import in_words, table
from words import duration, host, load, percent, quantile

PROGRAMS = {"kernels": Kernels, "ccdt": Ccdt}
MOST_PADDING = 4096  # bytes of environment, as in the gate


def measure(program, arguments):
    layouts = program.layouts(arguments.layouts, arguments.copies)
    file = program.folder / "rounds.jsonl"
    done = file.read_text().count("\n") if file.exists() else 0
    deadline = time.monotonic() + 60 * arguments.minutes
    for number in range(done, arguments.runs):
        if time.monotonic() > deadline:
            break
        drawn = random.Random(f"{arguments.seed} {number}")
        turns = [(name, task) for name in layouts for task in program.tasks]
        drawn.shuffle(turns)
        began, seconds = time.time(), {name: {} for name in layouts}
        for name, task in turns:
            seconds[name].update(program.seconds(layouts[name], task, drawn.randrange(MOST_PADDING)))
        with file.open("a") as out:
            out.write(json.dumps({"round": number, "began": began, "load": load(), "seconds": seconds}) + "\n")
        print(f"round {number + 1} of {arguments.runs}: {time.time() - began:.1f} s, load {load():.1f}", flush=True)
    if file.exists():
        write_measured(program)


def read_rounds(program):
    """The rounds, and the names of layouts and copies that are in all of them."""
    file = program.folder / "rounds.jsonl"
    if not file.exists():
        sys.exit(f"nothing is measured in {program.folder}; start with `measure`")
    rounds = [json.loads(line) for line in file.read_text().split("\n") if line]
    names = [name for name in rounds[0]["seconds"] if all(name in r["seconds"] for r in rounds)]
    return rounds, *([name for name in names if name.startswith(kind)] for kind in ("layout", "copy"))


def log_times(rounds, names, case):
    """A list of log times for each program of these names, without what whole rounds have in common."""
    return effects.without_rounds([[math.log(r["seconds"][name][case]) for name in names] for r in rounds])


def with_interval(result):
    return "{} [{}, {}]".format(*(percent(result[key]) for key in ("between", "low", "high")))


def write_measured(program):
    rounds, layouts, copies = read_rounds(program)
    if len(rounds) < 5:
        return
    rows = [["case", "time", "sd of a run", "sd between layouts", "largest difference", "sd between copies"]]
    results = []
    for case in program.cases:
        logs = log_times(rounds, layouts, case)
        of_layouts = effects.random_effects(logs)
        of_copies = effects.random_effects(log_times(rounds, copies, case)) if len(copies) > 2 else None
        seconds = math.exp(effects.trimmed_mean([math.log(r["seconds"][n][case]) for r in rounds for n in layouts]))
        rows.append([case, duration(seconds), percent(of_layouts["within"]), with_interval(of_layouts),
                     percent(math.expm1(of_layouts["largest_difference"])),
                     with_interval(of_copies) if of_copies else "-"])
        results.append({"case": case, "seconds": seconds, "layouts": of_layouts, "copies": of_copies})
    sigmas = [result["layouts"]["between"] for result in results]
    pooled = {"median": quantile(sigmas, 0.5), "p90": quantile(sigmas, 0.9),
              "root_mean_square": math.sqrt(sum(sigma**2 for sigma in sigmas) / len(sigmas))}
    over_cases = ", ".join(f"{name} {percent(pooled[key])}" for name, key in
                           (("median", "median"), ("90th percentile", "p90"), ("root mean square", "root_mean_square")))
    text = (f"{len(layouts)} layouts of `{program.name}`, {len(rounds)} runs of each in random turns; "
            f"{program.figure}. Host: {host([r['load'] for r in rounds])}. "
            "Standard deviations (sd) of logarithms, with 95% intervals.\n\n" + table(rows) +
            f"\nSd between layouts over the cases: {over_cases}.\n")
    (program.folder / "layouts.json").write_text(json.dumps(
        {"schema": "ccdt.layouts/1", "program": program.name, "runs": len(rounds), "pooled": pooled, "cases": results},
        indent=1))
    (program.folder / "layouts.md").write_text(text)
    print(text)


def methods_of(sigmas, arguments):
    """The gates that are simulated."""
    def floors_of(name, sigma_of):
        floors = {case: simulated.layout_floor(sigma_of(case), len(sigmas)) for case in sigmas}
        low, high = (percent(math.expm1(bound), 1) for bound in (min(floors.values()), max(floors.values())))
        return simulated.Method(f"two builds, {name}: floor {low if low == high else f'{low} to {high}'}", floors)

    return [simulated.Method("two builds, no floor"),
            *(floors_of(f"sd between layouts {percent(sigma, 1)}", lambda _, sigma=sigma: sigma)
              for sigma in arguments.deviations),
            floors_of("the sd of each case", sigmas.get),
            *(simulated.Method(f"rebuilt, {count} layouts a side at first", layouts=count)
              for count in arguments.counts)]


def resample(program, arguments):
    rounds, names, _ = read_rounds(program)
    logs = {case: log_times(rounds, names, case) for case in program.cases if case not in arguments.without}
    sigmas = {case: effects.random_effects(groups)["between"] for case, groups in logs.items()}
    logs = {case: effects.without_noise_of_means(groups, arguments.noise) for case, groups in logs.items()}
    layouts = simulated.Layouts(logs, arguments.seed)
    rows = [["gate", "false alarms", "undecided", "5% in one case found", "that case undecided", "pairs"]]
    results = []
    for method in methods_of(sigmas, arguments):
        counts = simulated.simulate(layouts, method, arguments.simulations)
        shares = (in_words(counts[what], counts["gates"]) for what in ("worse", "undecided", "found", "slow_undecided"))
        rows.append([method.name, *shares, f"{counts['pairs']:.0f}"])
        results.append({"gate": method.name, "layouts": method.layouts, "floors": method.floors, **counts})
        print(f"simulated: {method.name}", flush=True)
    text = (f"{arguments.simulations} simulated gates of {len(logs)} cases for each row, from {len(rounds)} runs of "
            f"{len(names)} layouts of `{program.name}`. The noise of a run is {arguments.noise:g} times that of the "
            "measurement. Pairs: of the case with most; the median of the gates without a slower case.\n\n" +
            table(rows))
    (program.folder / "resample.json").write_text(json.dumps(
        {"schema": "ccdt.layouts-resampled/1", "program": program.name, "noise": arguments.noise, "gates": results},
        indent=1))
    (program.folder / "resample.md").write_text(text)
    print(text)


PARTS = {"measure": measure, "resample": resample, "gates": run_gates}


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where everything is built and measured")
    parser.add_argument("part", choices=PARTS)
    parser.add_argument("--program", choices=PROGRAMS, default="kernels")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=float("inf"), help="stop after this time, with a table")
    parser.add_argument("--build", type=Path, default=Path("build/release"),
                        help="build folder whose objects are linked again to `ccdt`; it is only read")
    parser.add_argument("--flags", type=shlex.split, default=[], metavar="WORDS",
                        help="more flags for the compiler of the kernels")
    parser.add_argument("--min-time", type=float, default=0.02, help="seconds of each benchmark in measure")
    parser.add_argument("--layouts", type=int, default=10)
    parser.add_argument("--copies", type=int, default=0, help="copies of one layout, to compare with")
    parser.add_argument("--runs", type=int, default=20, help="of each layout")
    parser.add_argument("--simulations", type=int, default=1000, help="simulated gates of each row")
    parser.add_argument("--noise", type=float, default=1.0, help="factor of the noise of runs in resample")
    parser.add_argument("--counts", type=int, nargs="*", default=[4, 8, 16, 32], help="layouts a side in resample")
    parser.add_argument("--deviations", type=float, nargs="*", default=[0.005, 0.015],
                        help="standard deviations between layouts that floors follow from in resample")
    parser.add_argument("--without", nargs="+", default=[], metavar="CASE", help="cases to leave out in resample")
    parser.add_argument("--gates", type=int, nargs=len(KINDS), default=[40] * len(KINDS), metavar="N",
                        help="how many of each kind: " + "; ".join(kind["name"] for kind in KINDS).replace("%", "%%"))
    parser.add_argument("--ccdt", type=Path, default=Path("build/release/ccdt"), help="the program that runs the gates")
    parser.add_argument("--gate-options", type=shlex.split, default=[], metavar="WORDS",
                        help="more options of all gates")
    parser.add_argument("--rebuild-options", type=shlex.split, default=[], metavar="WORDS",
                        help="more options of the gates that rebuild")
    parser.add_argument("--self-test", action="store_true",
                        help="test the statistics on made-up data, and nothing else")
    end = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:end])
    arguments.words = words[end + 1:]  # for the programs of the gates
    return arguments


def main():
    if sys.argv[1:] == ["--self-test"]:
        import layouts_test
        layouts_test.main()
    arguments = arguments_of(sys.argv[1:])
    folder = arguments.folder.resolve() / arguments.program
    folder.mkdir(parents=True, exist_ok=True)
    program = PROGRAMS[arguments.program](folder, arguments)
    program.prepare()
    PARTS[arguments.part](program, arguments)


if __name__ == "__main__":
    main()
