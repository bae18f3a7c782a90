#!/usr/bin/env python3
"""Tests of mutations.py; one compiles a program with mutations and runs it."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # beside the source
import mutations as lists

ROOT = Path(__file__).resolve().parent.parent.parent

PROGRAM = """#include <cstdio>
int add(int a, int b) {
  int sum = 0;
  if (a > 0)
    sum = a + b;
  else
    sum = b;
  return sum;
}
int subtract(int a, int b) {
  return a - b;
}
int main() {
  std::printf("%d %d", add(1, 2), subtract(1, 2));
}
"""


def mutation(name, find, replace, kind="expression", **more):
    return {"id": name, "name": f"list/{name}", "file": "studies/mutation/program.cpp", "find": find, "replace": replace,
            "kind": kind, "what": "", "tests": "", **more}


class Mutations(unittest.TestCase):
    def test_one_program_has_all_mutations_and_the_environment_selects_one(self):
        some = [
            mutation("minus", "a + b", "a - b"),
            mutation("times", "a + b", "a * b"),
            mutation("inside", "b", "7", near="sum = a + "),
            mutation("dropped", "sum = a + b;", "", kind="statement"),
            mutation("other-branch", "sum = a + b;", "sum = b; sum += 10;", kind="statement"),
            mutation("swapped", "a - b", "b - a", near="int subtract"),
        ]
        with tempfile.TemporaryDirectory() as folder:
            source, program = Path(folder, "studies/mutation/program.cpp"), Path(folder, "program")
            source.parent.mkdir(parents=True)
            source.write_text(lists.rewrite(PROGRAM, some))
            (source.parent / "is_on.h").write_text((ROOT / lists.SWITCH).read_text())
            subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-Wall", "-Wextra", "-Werror", source, "-o", program],
                           check=True)

            def output(name):
                environment = {**os.environ, "CCDT_MUTATION": name, "CCDT_MUTATION_REACHED": f"{folder}/reached"}
                return subprocess.run([program], env=environment, capture_output=True, text=True, check=True).stdout

            self.assertEqual(output(""), "3 -1")
            self.assertEqual(output("list/unknown"), "3 -1")
            self.assertFalse(Path(folder, "reached").exists())
            self.assertEqual(output("list/minus"), "-1 -1")
            self.assertTrue(Path(folder, "reached").exists())
            self.assertEqual(output("list/times"), "2 -1")
            self.assertEqual(output("list/inside"), "8 -1")
            self.assertEqual(output("list/dropped"), "0 -1")
            self.assertEqual(output("list/other-branch"), "12 -1")
            self.assertEqual(output("list/swapped"), "3 1")

    def test_places_that_are_not_clear_are_refused(self):
        for wrong in (mutation("missing", "a / b", "a"), mutation("many", "sum", "b"),
                      mutation("near-many", "a + b", "a", near="sum"), mutation("before", "a + b", "a", near="a - b")):
            with self.assertRaises(lists.Wrong, msg=wrong["id"]):
                lists.rewrite(PROGRAM, [wrong])
        with self.assertRaises(lists.Wrong):
            lists.rewrite(PROGRAM, [mutation("left", "sum = a", "sum"), mutation("right", "a + b", "a")])
        with self.assertRaises(lists.Wrong):
            lists.rewrite("\n" * 50 + PROGRAM + "\n" * 50 + "a / b", [mutation("far", "a / b", "a", near="int main")])

    def test_lists_that_are_wrong_are_refused(self):
        lists.check_mutation(mutation("right", "a + b", "a"))
        for wrong in (mutation("Upper", "a", "b"), mutation("same", "a", "a"), mutation("open", "f(a", "b"),
                      mutation("not-expression", "a;", "b"), mutation("not-statement", "a", "b;", kind="statement"),
                      mutation("kind", "a", "b", kind="token"), mutation("empty", "a", "")):
            with self.assertRaises(lists.Wrong, msg=wrong["id"]):
                lists.check_mutation(wrong)
        self.assertTrue(lists.is_balanced('f("(", \')\', [](int a) { return a; })'))
        self.assertFalse(lists.is_balanced("a) + (b"))


if __name__ == "__main__":
    unittest.main()
