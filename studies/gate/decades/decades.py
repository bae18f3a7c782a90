#!/usr/bin/env python3
"""What slowdown does `ccdt gate` find, from 10 ns to 10 s per iteration? An experiment on this host.

Builds decades.cpp. A calibration says for each case which slowdown a gate finds 95 times in 100. Then gates are run whose
head does as much work, 5% more, and ten times as much. Writes decades.json and decades.md. Finished gates are kept: call it
again to continue.

Example: an hour on an idle host
  studies/gate/decades/decades.py build/decades
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # beside the source
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import methods

# Cases that are measured together, pairs of their calibration, and gates of each kind: as much work, 5% more, tenfold.
GROUPS = [
    (["10ns", "100ns", "1us", "10us", "100us", "1ms", "10ms"], 100, {1: 5, 1.05: 5, 10: 3}),
    (["100ms", "1s"], 40, {1: 3, 1.05: 3, 10: 1}),
    (["10s"], 40, {}),
]


def gate(ccdt, folder, arguments, cases):
    command = [ccdt, "gate", *arguments, "-o", folder, "--", f"--benchmark_filter=^({'|'.join(cases)})/"]
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def calibrate(ccdt, folder, program, cases, pairs):
    out = folder / "calibration" / cases[0]
    file = out / "calibration.json"
    if not file.exists():
        ended = gate(ccdt, out, ["--base", program, "--calibrate", "--pairs", pairs], cases)
        if ended.returncode == 3:  # too few pairs: it says how many it needs
            pairs = ended.stderr.split("--pairs ")[1].split()[0]
            ended = gate(ccdt, out, ["--base", program, "--calibrate", "--pairs", pairs], cases)
        if ended.returncode != 0:
            sys.exit(ended.stdout + ended.stderr)
    return {one["case"].split("/")[0]: one for one in json.loads(file.read_text())["cases"]}


def run_gate(ccdt, folder, program, cases, factor, number):
    """The verdict on each case of a gate whose head does `factor` times as much work."""
    out = folder / "gates" / f"{cases[0]}-{factor}-{number:03}"
    if not (out / "verdict.json").exists():
        ended = gate(ccdt, out, ["--base", f"env SLOWER=1 {program}", "--head", f"env SLOWER={factor} {program}"], cases)
        if ended.returncode not in (0, 1, 5):
            sys.exit(ended.stdout + ended.stderr)
    figures = json.loads((out / "verdict.json").read_text())["figures"]
    return {figure["case"].split("/")[0]: figure["verdict"] for figure in figures}


def in_words(verdicts, wanted):
    if not verdicts:
        return "-"
    value, low, high = methods.share(verdicts.count(wanted), len(verdicts))
    return f"{verdicts.count(wanted)} of {len(verdicts)} [{100 * low:.0f}%, {100 * high:.0f}%]"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where everything is built and measured")
    parser.add_argument("--ccdt", type=Path, default=HERE.parents[2] / "build" / "release" / "ccdt")
    parser.add_argument("--most", type=int, default=1000, help="gates of each kind, if fewer than planned")
    parser.add_argument("--groups", type=int, nargs="+", default=range(len(GROUPS)), help="only these groups of cases")
    arguments = parser.parse_args()
    folder, ccdt = arguments.folder.resolve(), arguments.ccdt.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / "decades"
    if not program.exists():
        subprocess.run(["g++", "-O2", "-std=c++17", HERE / "decades.cpp", "-o", program, "-lbenchmark", "-lpthread"], check=True)
    rows, lines = [], ["| time of an iteration | noise of a pair | smallest slowdown found | unchanged: worse | 5% slower: found | "
                       "tenfold: passed |", "|---|---|---|---|---|---|"]
    for group in arguments.groups:
        cases, pairs, gates = GROUPS[group]
        noise = calibrate(ccdt, folder, program, cases, pairs)
        verdicts = {factor: [run_gate(ccdt, folder, program, cases, factor, n) for n in range(min(count, arguments.most))]
                    for factor, count in gates.items()}
        for case in cases:
            of_case = {factor: [one[case] for one in some] for factor, some in verdicts.items()}
            smallest = noise[case].get("smallest_found")
            rows.append({"case": case, "seconds": noise[case]["seconds"], "deviation": noise[case]["deviation"],
                         "smallest_found": smallest, "verdicts": of_case})
            lines.append(f"| {case} | {100 * noise[case]['robust_deviation']:.1f}% | "
                         f"{f'{100 * smallest:.1f}%' if smallest else 'more than 100%'} | "
                         f"{in_words(of_case.get(1, []), 'worse')} | {in_words(of_case.get(1.05, []), 'worse')} | "
                         f"{in_words(of_case.get(10, []), 'passed')} |")
            print(lines[-1], flush=True)
    (folder / "decades.json").write_text(
        json.dumps({"schema": "ccdt.gate-decades/1", "load": os.getloadavg(), "rows": rows}, indent=1))
    (folder / "decades.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
