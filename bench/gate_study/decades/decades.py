#!/usr/bin/env python3
"""What slowdown does `ccdt gate` find, from 10 ns to 10 s per iteration? An experiment on this host.

Builds decades.cpp. Calibrates each case, which says the smallest slowdown that a gate finds 95 times in 100, and then runs
gates with that slowdown, with a tenfold one, and with none. Writes decades.json and decades.md. Finished gates are kept:
call it again to continue.

Example: all decades, 20 gates each up to 10 ms
  bench/gate_study/decades/decades.py build/decades
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

CASES = ["10ns", "100ns", "1us", "10us", "100us", "1ms", "10ms", "100ms", "1s", "10s"]
PAIRS = {"1s": 40, "10s": 40}  # of a calibration; the others take more
MOST_GATES = {"100ms": 5, "1s": 1, "10s": 0}


def gate(ccdt, folder, arguments, case):
    command = [ccdt, "gate", *arguments, "-o", folder, "--", f"--benchmark_filter=^{case}/"]
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def calibrate(ccdt, folder, program, case):
    out = folder / "calibration" / case
    file = out / "calibration.json"
    if not file.exists():
        ended = gate(ccdt, out, ["--base", program, "--calibrate", "--pairs", PAIRS.get(case, 100)], case)
        if ended.returncode == 3:  # too few pairs: it says how many it needs
            pairs = ended.stderr.split("--pairs ")[1].split()[0]
            ended = gate(ccdt, out, ["--base", program, "--calibrate", "--pairs", pairs], case)
        if ended.returncode != 0:
            sys.exit(ended.stdout + ended.stderr)
    return json.loads(file.read_text())["cases"][0]


def run_gates(ccdt, folder, program, case, factor, count):
    """The verdicts of gates whose head does `factor` times as much work."""
    verdicts = []
    for number in range(min(count, MOST_GATES.get(case, count))):
        out = folder / "gates" / f"{case}-{factor:.4f}-{number:03}"
        if not (out / "verdict.json").exists():
            head = program if factor == 1 else f"env SLOWER={factor} {program}"
            ended = gate(ccdt, out, ["--base", f"env SLOWER=1 {program}" if factor != 1 else program, "--head", head], case)
            if ended.returncode not in (0, 1, 5):
                sys.exit(ended.stdout + ended.stderr)
        verdicts.append(json.loads((out / "verdict.json").read_text())["verdict"])
    return verdicts


def in_words(hits, trials):
    if trials == 0:
        return "-"
    value, low, high = methods.share(hits, trials)
    return f"{hits} of {trials} [{100 * low:.0f}%, {100 * high:.0f}%]"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where everything is built and measured")
    parser.add_argument("--gates", type=int, default=20, help="of each kind and case")
    parser.add_argument("--ccdt", type=Path, default=HERE.parents[2] / "build" / "release" / "ccdt")
    parser.add_argument("--cases", nargs="+", default=CASES, choices=CASES)
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / "decades"
    if not program.exists():
        subprocess.run(["g++", "-O2", "-std=c++17", HERE / "decades.cpp", "-o", program, "-lbenchmark", "-lpthread"], check=True)
    rows, lines = [], ["| time of an iteration | noise of a pair | smallest slowdown found | found with it | unchanged: worse | "
                       "tenfold: passed |", "|---|---|---|---|---|---|"]
    for case in arguments.cases:
        noise = calibrate(arguments.ccdt.resolve(), folder, program, case)
        smallest = noise.get("smallest_found")
        found = run_gates(arguments.ccdt.resolve(), folder, program, case, 1 + smallest, arguments.gates) if smallest else []
        same = run_gates(arguments.ccdt.resolve(), folder, program, case, 1, arguments.gates)
        tenfold = run_gates(arguments.ccdt.resolve(), folder, program, case, 10, min(arguments.gates, 5))
        rows.append({"case": case, "seconds": noise["seconds"], "deviation": noise["deviation"], "smallest_found": smallest,
                     "found": found, "same": same, "tenfold": tenfold})
        lines.append(f"| {case} | {100 * noise['robust_deviation']:.1f}% | "
                     f"{f'{100 * smallest:.1f}%' if smallest else 'more than 100%'} | "
                     f"{in_words(found.count('worse'), len(found))} | {in_words(same.count('worse'), len(same))} | "
                     f"{in_words(tenfold.count('passed'), len(tenfold))} |")
        print(lines[-1], flush=True)
    (folder / "decades.json").write_text(json.dumps({"schema": "ccdt.gate-decades/1", "load": os.getloadavg(), "rows": rows}, indent=1))
    (folder / "decades.md").write_text("\n".join(lines) + "\n")
    print((folder / "decades.md").read_text())


if __name__ == "__main__":
    main()
