#!/usr/bin/env python3
"""How often does `ccdt gate` raise a false alarm, and what does it miss? An experiment on this host.

Builds the program, copies of it, and programs that are slower by a known share (slowdown.patch). Runs time gates of all
kinds, which take turns, and writes study.json and study.md. Finished gates are kept: call it again to continue.

Example: all 600 gates
  studies/gate/study.py build/gate-study
Example: four gates of each kind
  studies/gate/study.py build/gate-study-small --gates 4 4 4 4
"""

import argparse
import json
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.dont_write_bytecode = True  # beside the source
import methods

HERE = Path(__file__).resolve().parent

# A kind of gate: its name, a description, the programs of base and head, and whether there is a load half of the time.
KINDS = [
    {"name": "A/A", "what": "one program, a load half of the time", "head": "base", "load": True},
    {"name": "copies", "what": "copies in other folders, environments of other sizes", "head": "copy", "wrapped": True},
    {"name": "A/B 5%", "what": "5% slower", "head": "slower-5", "slower": True},
    {"name": "A/B 3%", "what": "3% slower", "head": "slower-3", "slower": True},
]
SLOWDOWNS = {"slower-5": 0.05, "slower-3": 0.03}

# Cases of about 15 ms, so that a gate takes some seconds.
MODELS = [("bracket", 8), ("piston", 10)]
LOAD_MODEL = ("stepping-pole", 2)

CMAKE_OPTIONS = ["-DCCDT_BUILD_TESTS=OFF", "-DCCDT_BUILD_BENCHMARKS=OFF", "-DCCDT_BUILD_PAGE=OFF",
                 "-DCCDT_WITH_CGAL_MESHERS=OFF"]


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, **options)


def program(folder, name):
    return folder / "programs" / name / "ccdt"


def build(source, folder, name):
    run("cmake", "--build", "--preset", "release", "--target", "ccdt", cwd=source, stdout=subprocess.DEVNULL)
    program(folder, name).parent.mkdir(parents=True, exist_ok=True)
    shutil.copy2(source / "build" / "release" / "ccdt", program(folder, name))


def make_programs(repository, folder):
    """The program as it is, and slower ones, each linked anew from a copy of the source."""
    if all(program(folder, name).exists() for name in ["base", "copy", *SLOWDOWNS]):
        return
    source = folder / "source"
    shutil.rmtree(source, ignore_errors=True)
    source.mkdir(parents=True)
    archive = subprocess.run(["git", "-C", repository, "archive", "HEAD"], check=True, capture_output=True).stdout
    run("tar", "x", "-C", source, input=archive)
    revision = subprocess.run(["git", "-C", repository, "rev-parse", "HEAD"], check=True, capture_output=True, text=True)
    (folder / "revision").write_text(revision.stdout)
    run("cmake", "--preset", "release", *CMAKE_OPTIONS, cwd=source, stdout=subprocess.DEVNULL)
    build(source, folder, "base")
    # The copy of the source is not a repository, even if it is inside one.
    run("git", "apply", HERE / "slowdown.patch", cwd=source, env={**os.environ, "GIT_CEILING_DIRECTORIES": str(folder)})
    header = source / "engine" / "test_slowdown.h"
    for name, share in SLOWDOWNS.items():
        header.write_text(re.sub(r"= [0-9.]+;", f"= {share};", header.read_text()))
        build(source, folder, name)
    program(folder, "copy").parent.mkdir(parents=True, exist_ok=True)
    shutil.copy2(program(folder, "base"), program(folder, "copy"))


def make_cases(folder):
    inputs = folder / "inputs"
    inputs.mkdir(exist_ok=True)
    for model, edge_length in [*MODELS, LOAD_MODEL]:
        if not (inputs / f"{model}.poly").exists():
            run(program(folder, "base"), "model", model, "--edge-length", edge_length, "-o", inputs / f"{model}.poly",
                stdout=subprocess.DEVNULL)
    spec = {"schema": "ccdt.sweep/1", "name": "gate-study", "inputs": [{"files": f"inputs/{m}.poly"} for m, _ in MODELS]}
    (folder / "cases.json").write_text(json.dumps(spec, indent=2))


class Load:
    """Meshes on the last core for half of the time, in bursts of random length."""

    def __init__(self, folder, seed):
        self.command = [program(folder, "base"), "mesh", folder / "inputs" / f"{LOAD_MODEL[0]}.poly", "-o",
                        folder / "load.mesh"]
        self.random = random.Random(seed)
        self.stopped = threading.Event()
        self.thread = threading.Thread(target=self.work)

    def work(self):
        last_core = {max(os.sched_getaffinity(0))}
        if self.random.random() < 0.5:
            self.stopped.wait(self.random.uniform(0.2, 1.5))
        while not self.stopped.is_set():
            begin = time.monotonic()
            wanted = self.random.uniform(0.2, 1.5)
            while time.monotonic() < begin + wanted and not self.stopped.is_set():
                subprocess.run(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: os.sched_setaffinity(0, last_core))
            self.stopped.wait(time.monotonic() - begin)

    def __enter__(self):
        self.thread.start()

    def __exit__(self, *_):
        self.stopped.set()
        self.thread.join()


def wrapped(folder, name, bytes_more):
    """A program whose environment is larger by this many bytes."""
    script = folder / name
    script.write_text(f"#!/bin/sh\nSTUDY={'x' * bytes_more} exec '{program(folder.parent.parent, name)}' \"$@\"\n")
    script.chmod(0o755)
    return script


def run_gate(folder, kind, number, seed, ccdt):
    gate = folder / "gates" / f"{re.sub('[^A-Za-z0-9]+', '-', kind['name'])}-{number:03}"
    record = gate / "gate.json"
    if record.exists():
        return json.loads(record.read_text())
    shutil.rmtree(gate, ignore_errors=True)
    gate.mkdir(parents=True)
    random_of_gate = random.Random(f"{seed} {gate.name}")
    base, head = (program(folder, name) for name in ("base", kind["head"]))
    if kind.get("wrapped"):
        base, head = (wrapped(gate, name, random_of_gate.randrange(0, 8192)) for name in ("base", kind["head"]))
    command = [ccdt, "gate", "--base", base, "--head", head, "--sweep", folder / "cases.json", "--layers", "time",
               "-o", gate / "out"]
    begin = time.time()
    if kind.get("load"):
        with Load(folder, random_of_gate.random()):
            ended = subprocess.run(command, capture_output=True, text=True)
    else:
        ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode not in (0, 1, 5):
        sys.exit(f"a gate ended with {ended.returncode}: {' '.join(map(str, command))}\n{ended.stdout}{ended.stderr}")
    verdict = json.loads((gate / "out" / "verdict.json").read_text())
    result = {"kind": kind["name"], "number": number, "verdict": verdict["verdict"], "exit_code": ended.returncode,
              "began": begin, "seconds": time.time() - begin}
    record.write_text(json.dumps(result))
    return result


def times_of(folder, gate):
    """Base and head seconds of each case, of all pairs."""
    name = f"{re.sub('[^A-Za-z0-9]+', '-', gate['kind'])}-{gate['number']:03}"
    samples = json.loads((folder / "gates" / name / "out" / "samples.json").read_text())
    for case in samples["cases"]:
        pairs = case["screening"] + case["confirmation"]
        yield case["case"], [pair["base"] for pair in pairs], [pair["head"] for pair in pairs]


def judge_otherwise(folder, gates):
    """What other methods say of the same times. A gate fires if one of its cases does."""
    u_test, u_test_name = methods.compare_py()
    for gate in gates:
        cases = list(times_of(folder, gate))
        few = [(name, base[:methods.FEW], head[:methods.FEW]) for name, base, head in cases]
        gate["pairs"] = sum(len(base) for _, base, _ in cases)
        gate["ratios"] = {name: statistics.median(h / b for b, h in zip(base, head)) for name, base, head in cases}
        gate["fires"] = {
            "ccdt gate": gate["verdict"] == "worse",
            f"{u_test_name}, p < {methods.ALPHA}": any(methods.u_test_fires(u_test, b, h) for _, b, h in cases),
            "medians of all, limit 10%": any(methods.median_fires(b, h) for _, b, h in cases),
            f"medians of {methods.FEW}, limit 10%": any(methods.median_fires(b, h) for _, b, h in few),
        }


def in_words(hits, trials):
    if trials == 0:
        return "-"
    value, low, high = methods.share(hits, trials)
    return f"{hits} of {trials} ({100 * value:.1f}% [{100 * low:.1f}, {100 * high:.1f}])"


def table(rows):
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    lines.insert(1, "|" + "---|" * len(rows[0]))
    return "\n".join(lines) + "\n"


def write_results(folder, gates):
    judge_otherwise(folder, gates)
    of_kind = {kind["name"]: [gate for gate in gates if gate["kind"] == kind["name"]] for kind in KINDS}
    verdicts = [["programs", "gates", "worse", "undecided", "median ratio", "seconds and pairs of a gate"]]
    for kind in KINDS:
        some = of_kind[kind["name"]]
        if not some:
            continue
        count = {v: sum(gate["verdict"] == v for gate in some) for v in ("worse", "undecided")}
        ratio = statistics.median(ratio for gate in some for ratio in gate["ratios"].values())
        verdicts.append([f"{kind['name']}: {kind['what']}", str(len(some)), in_words(count["worse"], len(some)),
                         in_words(count["undecided"], len(some)), f"{ratio:.4f}",
                         f"{statistics.median(gate['seconds'] for gate in some):.1f} s, "
                         f"{statistics.median(gate['pairs'] for gate in some):.0f}"])
    compared = [["method", *(("found" if kind.get("slower") else "false alarms") + f": {kind['name']}" for kind in KINDS)]]
    for method in gates[0]["fires"]:
        compared.append([method] + [in_words(sum(gate["fires"][method] for gate in of_kind[kind["name"]]),
                                             len(of_kind[kind["name"]])) for kind in KINDS])
    revision = (folder / "revision").read_text().strip()
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    host = f"{cpu.group(1) if cpu else 'unknown processor'}, {os.cpu_count()} cores"
    (folder / "study.json").write_text(json.dumps(
        {"schema": "ccdt.gate-study/1", "revision": revision, "host": host, "gates": gates}, indent=1))
    (folder / "study.md").write_text(
        f"Shares have 95% intervals (Clopper and Pearson). Host: {host}; revision {revision[:12]}.\n\n" +
        calibration_in_words(folder) + table(verdicts) +
        "\nOn the same times, a gate fires if one of its cases does:\n\n" + table(compared))


def calibration_in_words(folder):
    file = folder / "calibration" / "calibration.json"
    if not file.exists():
        return ""
    calibration = json.loads(file.read_text())
    rate = calibration["rates"]["false_alarms"]
    smallest = ", ".join(f"{case['case']} {100 * case['smallest_found']:.1f}%" if "smallest_found" in case
                         else f"{case['case']} none" for case in calibration["cases"])
    return (f"The calibration said before: false alarms {100 * rate['value']:.1f}% [{100 * rate['low']:.1f}, "
            f"{100 * rate['high']:.1f}]; smallest slowdown of one case alone that is found in 95% of gates: {smallest}.\n\n")


def calibrate(folder, ccdt):
    """Measures the noise of this host, before the gates run."""
    out = folder / "calibration"
    if not (out / "calibration.json").exists():
        run(ccdt, "gate", "--base", program(folder, "base"), "--sweep", folder / "cases.json", "--calibrate", "--pairs", "200", "-o",
            out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where everything is built and measured")
    parser.add_argument("--gates", type=int, nargs=len(KINDS), default=[200, 200, 100, 100],
                        metavar="N", help="how many of each kind: " + ", ".join(kind["name"] for kind in KINDS).replace("%", "%%"))
    parser.add_argument("--minutes", type=float, default=float("inf"), help="stop after this time, with a table")
    parser.add_argument("--source", type=Path, default=HERE.parent.parent, help="repository whose HEAD is built")
    parser.add_argument("--ccdt", type=Path, help="the program that runs the gates; default: the one that is built")
    parser.add_argument("--seed", type=int, default=1, help="seed of loads and environments; gates have seeds of their own")
    parser.add_argument("--no-calibration", action="store_true", help="do not measure the noise of the host first")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    make_programs(arguments.source, folder)
    make_cases(folder)
    ccdt = arguments.ccdt.resolve() if arguments.ccdt else program(folder, "base")
    if not arguments.no_calibration:
        calibrate(folder, ccdt)

    # In turns, so that changes over the day affect all kinds alike.
    plan = sorted(((n + 0.5) / count, i, n) for i, count in enumerate(arguments.gates) for n in range(count))
    deadline = time.monotonic() + 60 * arguments.minutes
    gates = []
    for done, (_, i, n) in enumerate(plan):
        if time.monotonic() > deadline:
            break
        gates.append(run_gate(folder, KINDS[i], n, arguments.seed, ccdt))
        print(f"{done + 1} of {len(plan)}: {KINDS[i]['name']}: {gates[-1]['verdict']}, {gates[-1]['seconds']:.1f} s",
              flush=True)
    if gates:
        write_results(folder, gates)
        print((folder / "study.md").read_text())


if __name__ == "__main__":
    main()
