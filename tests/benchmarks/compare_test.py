#!/usr/bin/env python3
"""The comparison of stages: its arithmetic, its verdicts on programs of which the times are known, and a program with
itself.

    python3 tests/benchmarks/compare_test.py build/tests/benchmarks/stage_benchmark
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import ratios
import stage_runs

COMPARE = pathlib.Path(__file__).resolve().parent / "compare"
PROGRAM = None  # stage_benchmark, when its place is given

# Answers as stage_benchmark does, with the seconds it was made with.
FAKE = """#!/usr/bin/env python3
import json, sys
answer = {{"scenes": {{"scene": {{"stages": {stages}}}}}}}
open(sys.argv[sys.argv.index("--json") + 1], "w").write(json.dumps(answer))
"""


def compare(*given):
    return subprocess.run([sys.executable, COMPARE, *map(str, given)], capture_output=True, text=True, check=False)


class Arithmetic(unittest.TestCase):
    def test_ratios_of_pairs_are_those_of_medians(self):
        self.assertEqual(ratios.pair_ratios([[1, 2, 9], [4]], [[3, 1, 1], [6]]), [0.5, 1.5])

    def test_quartiles_are_interpolated(self):
        self.assertEqual(ratios.quartiles([1, 2, 3, 4, 5]), (2, 3, 4))
        self.assertEqual(ratios.quartiles([7]), (7, 7, 7))

    def test_slower_beyond_the_noise_only(self):
        self.assertTrue(ratios.slower([1.10, 1.11, 1.12, 1.10, 1.11]))
        self.assertFalse(ratios.slower([1.02, 1.02, 1.02, 1.02, 1.02]), "less than the least slowdown")
        self.assertFalse(ratios.slower([0.9, 1.3, 1.1, 1.0, 1.2]), "the quartiles are 0.2 apart")
        self.assertFalse(ratios.slower([0.5, 0.5, 0.5]), "faster")
        self.assertFalse(ratios.slower([2, 2]), "two pairs do not show their noise")

    def test_distance_is_cost_over_the_kernels_needed(self):
        costs, units = {"factorisation": 10, "back_solve": 64}, {"factorisation": 1, "back_solve": 32}
        self.assertEqual(ratios.distance(90, {"factorisation": 1, "back_solve": 10}, costs, units), 3)
        self.assertIsNone(ratios.distance(90, {}, costs, units))

    def test_baseline_verdicts(self):
        stored = {"s": {"a": {"instructions": 100}, "b": {"instructions": 100}, "c": {"instructions": 100},
                        "gone": {"instructions": 1}}}
        rows = ratios.against_baseline({"s": {"a": 101, "b": 103, "c": 90}}, stored, 0.02)
        self.assertEqual([(stage, verdict) for _, stage, _, verdict in rows], [("a", ""), ("b", "slower"), ("c", "faster")])


class Verdicts(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def program(self, name, **seconds):
        path = pathlib.Path(self.folder.name) / name
        stages = {stage: {"seconds": [value] * 3} for stage, value in seconds.items()}
        path.write_text(FAKE.format(stages=json.dumps(stages)), encoding="utf-8")
        path.chmod(0o755)
        return path

    def test_the_slower_stage_is_named(self):
        a, b = self.program("a", mesh=1.0, modes=1.0), self.program("b", mesh=1.2, modes=0.8)
        done = compare(a, b, "--pairs", 3)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("slower: scene mesh (time)", done.stdout)
        self.assertRegex(done.stdout, r"scene +mesh +1\.200")
        self.assertRegex(done.stdout, r"scene +modes +0\.800")

    def test_faster_is_no_failure(self):
        a, b = self.program("a", mesh=1.0), self.program("b", mesh=0.5)
        self.assertEqual(compare(a, b, "--pairs", 3).returncode, 0)

    def test_wrong_input_is_one_sentence(self):
        no_commit = "no_such_commit is no commit" if shutil.which("git") else "git is not installed"
        for given, words in ((("no_such_commit", "HEAD"), no_commit),
                             ((self.folder.name, "."), "is no working tree that can be compared")):
            done = compare(*given)
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertEqual(compare("HEAD").returncode, 2)
        self.assertEqual(compare("--baseline", "--store").returncode, 2)

    @unittest.skipUnless(shutil.which("git"), "git is not installed")
    def test_a_commit_without_the_benchmark_is_refused(self):
        first = stage_runs.git("rev-list", "--max-parents=0", "HEAD").stdout.split()
        if not first or stage_runs.git("cat-file", "-e", f"{first[-1]}:{stage_runs.SOURCE}").returncode == 0:
            self.skipTest("the sources are in no repository that has such a commit")
        done = compare(first[-1], first[-1])
        self.assertEqual(done.returncode, 2)
        self.assertIn("stages can be compared from the commit on that brought it", done.stderr)


class WithItself(unittest.TestCase):
    GIVEN = ("--scenes", "section_34", "--stages", "feasibility,mesh")

    def setUp(self):
        if PROGRAM is None:
            self.skipTest("no program was given")

    def test_times(self):
        done = compare(PROGRAM, PROGRAM, "--pairs", 1, *self.GIVEN)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"section_34 +mesh +[0-9.]+ ")

    def test_counts_are_the_same(self):
        if not shutil.which("valgrind"):
            self.skipTest("valgrind is not installed")
        if b"__asan_init" in PROGRAM.read_bytes():
            self.skipTest("valgrind cannot run programs that are built with sanitisers")
        done = compare(PROGRAM, PROGRAM, "--pairs", 0, "--counts", *self.GIVEN)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        counts = re.findall(r"section_34 +\w+ +([0-9.]+)$", done.stdout, re.MULTILINE)
        self.assertEqual(len(counts), 2, done.stdout)
        for ratio in counts:
            self.assertAlmostEqual(float(ratio), 1, delta=1e-3)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
