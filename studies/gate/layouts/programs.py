"""The programs whose layouts are measured: how they are built, linked anew and timed."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
RELINK = [sys.executable, HERE / "relink"]
SOURCES = Path("studies/gate/layouts/kernels")  # in the repository
FLAGS = ["-std=c++20", "-O2", "-DNDEBUG", "-ffunction-sections", "-fdata-sections"]
LINK_WORDS = ["-lbenchmark_main", "-lbenchmark", "-lpthread"]


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def timed(*command, padding):
    """Runs a program with an environment that is larger by this many bytes."""
    run(*command, env={**os.environ, "CCDT_LAYOUT_PADDING": "x" * padding}, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL)


def link(program, output, seed, side):
    if output.exists():
        return
    output.parent.mkdir(parents=True, exist_ok=True)
    new = output.with_name("new")
    run(*RELINK, env={**os.environ, "CCDT_GATE_SIDE": side, "CCDT_GATE_SEED": str(seed),
                     "CCDT_GATE_PROGRAM": str(program), "CCDT_GATE_OUTPUT": str(new)})
    new.rename(output)


class Program:
    """A program with its layouts, and copies of the first one: a spread between those is no effect of the layout."""

    def __init__(self, folder):
        self.folder = folder

    def base(self):
        return self.folder / "base" / self.name

    def same(self):
        """The base at another path."""
        if not (self.folder / "same" / self.name).exists():
            shutil.copytree(self.base().parent, self.folder / "same")
        return self.folder / "same" / self.name

    def layouts(self, count, copies):
        programs = {}
        for i in range(count):
            programs[f"layout {i}"] = self.folder / "layouts" / f"{i:03}" / self.name
            link(self.base(), programs[f"layout {i}"], i, "layout")
        for i in range(copies):
            copy = programs[f"copy {i}"] = self.folder / "copies" / f"{i:03}" / self.name
            if not copy.exists():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(programs["layout 0"], copy)
        return programs


class Kernels(Program):
    """Ten benchmarks in one program."""

    name = "kernels"
    figure = "real time of an iteration"
    cases = ["bits", "hash", "heap", "matrix", "numbers", "search", "sort", "sparse", "tokenizer", "tree"]
    tasks = ["all"]  # what is run at once

    def __init__(self, folder, arguments):
        super().__init__(folder)
        self.flags = arguments.flags
        self.min_time = arguments.min_time

    def prepare(self):
        self.make("base")

    def make(self, name, slow=None, share=0.0):
        """Compiles the program, or one with a slower benchmark. Objects that do not differ are taken from the base."""
        place = self.folder / name
        program = place / self.name
        if program.exists():
            return program
        shutil.rmtree(place, ignore_errors=True)
        (place / "objects").mkdir(parents=True)
        sources = place / "source" / SOURCES
        shutil.copytree(HERE / "kernels", sources)
        if slow:
            header = sources / "slowdown.h"
            text = re.sub(r'slow_kernel = "\w*"', f'slow_kernel = "{slow}"', header.read_text())
            header.write_text(re.sub(r"slowdown = [0-9.]+;", f"slowdown = {share};", text))
        for source in sorted(sources.glob("*.cpp")):
            compiled = place / "objects" / f"{source.stem}.o"
            if slow and f'passes_of("{slow}"' not in source.read_text():
                shutil.copy2(self.folder / "base" / "objects" / compiled.name, compiled)
            else:
                run("nice", "g++", *FLAGS, *self.flags, "-I", place / "source", "-c", source, "-o", compiled)
        (place / "link-words").write_text("\n".join(LINK_WORDS) + "\n")
        link(program, program, 0, "base")
        return program

    def gate_inputs(self):
        return []

    def seconds(self, program, task, padding):
        out = self.folder / "run.json"
        timed(program, f"--benchmark_min_time={self.min_time}", f"--benchmark_out={out}",
              "--benchmark_out_format=json", padding=padding)
        unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
        return {b["name"]: b["real_time"] * unit[b["time_unit"]] for b in json.loads(out.read_text())["benchmarks"]}


class Ccdt(Program):
    """The program of this repository, linked again from the objects of a build. The build itself is not changed."""

    name = "ccdt"
    figure = "`seconds.mesh`"
    # Models with their edge lengths. Each takes 10 to 60 ms on one thread.
    models = [("bracket", 6), ("bracket", 8), ("piston", 8), ("piston", 10), ("stepping-pole", 8),
              ("rough-sphere", 0.2), ("torus", 0.15), ("sphere", 0.15), ("cube", 0.1), ("graded-cube", 0.25)]
    cases = tasks = [f"{model}-{edge_length}" for model, edge_length in models]

    def __init__(self, folder, arguments):
        super().__init__(folder)
        self.build = arguments.build.resolve()

    def prepare(self):
        if not self.base().exists():
            self.collect_objects()
            link(self.base(), self.base(), 0, "base")
        inputs = self.folder / "inputs"
        inputs.mkdir(exist_ok=True)
        for (model, edge_length), name in zip(self.models, self.cases):
            if not (inputs / f"{name}.poly").exists():
                run(self.base(), "model", model, "--edge-length", edge_length, "-o", inputs / f"{name}.poly",
                    stdout=subprocess.DEVNULL)
        files = [{"files": f"inputs/{name}.poly"} for name in self.cases]  # sweeps use one thread
        (self.folder / "cases.json").write_text(
            json.dumps({"schema": "ccdt.sweep/1", "name": "layouts", "inputs": files}, indent=2))

    def collect_objects(self):
        """Sorts the words of the build's last command: `: && c++ FLAGS OBJECTS -o ccdt LIBRARIES && :`."""
        place = self.folder / "base"
        shutil.rmtree(place, ignore_errors=True)
        objects, of_libraries = place / "objects", place / "library-objects"
        objects.mkdir(parents=True)
        of_libraries.mkdir()
        commands = run("ninja", "-C", self.build, "-t", "commands", "ccdt", capture_output=True, text=True).stdout
        words = shlex.split(commands.strip().split("\n")[-1])
        words = words[words.index("&&") + 2:]
        words = iter(words[:words.index("&&")])
        others = []
        for word in words:
            file = self.build / word
            name = re.sub(r"[^\w.]", "_", word)
            if word == "-o":
                next(words)
            elif word.endswith(".o"):
                shutil.copy2(file, objects / name)
            elif word.endswith(".a") and file.resolve().is_relative_to(self.build):
                self.extract(file, of_libraries, name)
            elif not word.startswith("-Wl,--dependency-file"):
                others.append(word)
        (place / "link-words").write_text("\n".join(others) + "\n")

    @staticmethod
    def extract(archive, place, name):
        """Extracts all members of an archive, even if several have the same name."""
        seen = {}
        for member in run("ar", "t", archive, capture_output=True, text=True).stdout.split():
            seen[member] = seen.get(member, 0) + 1
            run("ar", "xN", seen[member], archive, member, cwd=place)
            (place / member).rename(place / f"{name}.{seen[member]}.{member}")

    def gate_inputs(self):
        return ["--sweep", self.folder / "cases.json"]

    def seconds(self, program, task, padding):
        report = self.folder / "run.json"
        timed(program, "mesh", self.folder / "inputs" / f"{task}.poly", "-o", self.folder / "run.mesh", "--report",
              report, "--threads", 1, padding=padding)
        return {task: json.loads(report.read_text())["seconds"]["mesh"]}
