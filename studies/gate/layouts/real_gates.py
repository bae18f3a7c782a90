"""Gates of two builds of one source, and of builds whose head is slower, with and without `--rebuild`."""

import json
import os
import random
import re
import shlex
import shutil
import subprocess
import sys
import time

from programs import RELINK, link
from study import in_words, table
from words import host, load, quantile

SLOWER = 0.05

# A kind of gate: its name, whether the head is slower, and how it treats layouts.
KINDS = [{"name": "A/A, two builds, no floor", "slower": False, "layouts": "bare"},
         {"name": "A/A, two builds", "slower": False, "layouts": "two"},
         {"name": "A/A, rebuilt", "slower": False, "layouts": "rebuilt"},
         {"name": "A/B 5%, two builds, no floor", "slower": True, "layouts": "bare"},
         {"name": "A/B 5%, two builds", "slower": True, "layouts": "two"},
         {"name": "A/B 5%, rebuilt", "slower": True, "layouts": "rebuilt"}]


def programs_of(program, kind, number, gate, seed):
    """Base and head, and the case that is slower. Each case is slower in turn."""
    slow = program.cases[number % len(program.cases)] if kind["slower"] else None
    head = program.make(f"slower-{slow}", slow, SLOWER) if slow else program.base()
    if kind["layouts"] == "rebuilt":
        return program.base(), head if slow else program.same(), slow
    drawn = random.Random(seed)
    layouts = [gate / side / program.name for side in ("base", "head")]
    for given, layout, side in zip((program.base(), head), layouts, ("base", "head")):
        link(given, layout, drawn.randrange(2**31), side)
    return *layouts, slow


def command_of(program, arguments, kind, gate, base, head):
    command = [arguments.ccdt.resolve(), "gate", "--base", base, "--head", head, "--layers", "time", "-o", gate / "out",
               *program.gate_inputs(), *arguments.gate_options]
    if kind["layouts"] == "rebuilt":
        command += ["--rebuild", shlex.join(map(str, RELINK)), *arguments.rebuild_options]
    if kind["layouts"] == "bare":
        (gate / "rules.json").write_text(json.dumps({"schema": "ccdt.rules/1", "time": {"layout_deviation": 0}}))
        command += ["--rules", gate / "rules.json"]
    return [str(word) for word in command + (["--", *arguments.words] if arguments.words else [])]


def run_gate(program, arguments, kind, number):
    gate = program.folder / "gates" / f"{re.sub('[^A-Za-z0-9]+', '-', kind['name'])}-{number:03}"
    record = gate / "gate.json"
    if record.exists():
        return json.loads(record.read_text())
    shutil.rmtree(gate, ignore_errors=True)
    gate.mkdir(parents=True)
    # Gates with and without a floor have the same layouts.
    seed = f"{arguments.seed} {kind['slower']} {number}"
    base, head, slow = programs_of(program, kind, number, gate, seed)
    command = command_of(program, arguments, kind, gate, base, head)
    began = time.time()
    # All gates give the same seeds to the command, so each gate adds its own.
    ended = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "CCDT_RELINK_SEED": seed})
    if ended.returncode not in (0, 1, 5):
        sys.exit(f"a gate ended with {ended.returncode}: {shlex.join(command)}\n{ended.stdout}{ended.stderr}")
    for programs in (gate / "out" / "layouts", gate / "base", gate / "head"):  # they are large
        shutil.rmtree(programs, ignore_errors=True)
    verdict = json.loads((gate / "out" / "verdict.json").read_text())
    of_cases = {figure["case"]: figure["verdict"] for figure in verdict["figures"]
                if figure["layer"] == "time" and "verdict" in figure}
    result = {"kind": kind["name"], "number": number, "verdict": verdict["verdict"], "slow": slow, "cases": of_cases,
              "began": began, "seconds": time.time() - began, "load": load()}
    record.write_text(json.dumps(result))
    return result


def run_gates(program, arguments):
    counts = [count if hasattr(program, "make") or not kind["slower"] else 0
              for kind, count in zip(KINDS, arguments.gates)]
    # In turns, so that changes over the day affect all kinds alike.
    plan = sorted(((n + 0.5) / count, i, n) for i, count in enumerate(counts) for n in range(count))
    deadline = time.monotonic() + 60 * arguments.minutes
    gates = []
    for done, (_, i, n) in enumerate(plan):
        if time.monotonic() > deadline:
            break
        gates.append(run_gate(program, arguments, KINDS[i], n))
        print(f"{done + 1} of {len(plan)}: {KINDS[i]['name']}: {gates[-1]['verdict']}, {gates[-1]['seconds']:.1f} s",
              flush=True)
    if gates:
        write_results(program, arguments, gates)


def write_results(program, arguments, gates):
    rows = [["gates of ten cases", "gates", "worse", "undecided", "the slower case found", "cases undecided",
             "seconds of a gate"]]
    for kind in KINDS:
        some = [gate for gate in gates if gate["kind"] == kind["name"]]
        if not some:
            continue
        worse, undecided = (in_words(sum(gate["verdict"] == verdict for gate in some), len(some))
                            for verdict in ("worse", "undecided"))
        found = in_words(sum(gate["cases"].get(gate["slow"]) == "worse" for gate in some), len(some))
        cases = [call for gate in some for call in gate["cases"].values()]
        rows.append([kind["name"], str(len(some)), worse, undecided, found if kind["slower"] else "-",
                     f"{cases.count('undecided')} of {len(cases)}",
                     f"{quantile([gate['seconds'] for gate in some], 0.5):.0f} s"])
    options = arguments.gate_options + arguments.rebuild_options
    options += ["--", *arguments.words] if arguments.words else []
    text = (f"Gates of `{program.name}`" + (f" with `{shlex.join(options)}`" if options else "") +
            f". Host: {host([gate['load'] for gate in gates])}. Shares have 95% intervals (Clopper and Pearson).\n\n" +
            table(rows))
    (program.folder / "gates.json").write_text(json.dumps(
        {"schema": "ccdt.layout-gates/1", "program": program.name, "options": options, "gates": gates}, indent=1))
    (program.folder / "gates.md").write_text(text)
    print(text)
