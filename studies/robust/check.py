#!/usr/bin/env python3
"""Runs the study in its quick form and checks its files:  check.py PATH_OF_ROBUST_JOINT"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = ""


class Robust(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = cls.kept.name
        command = [PROGRAM, cls.folder, "--study", os.path.join(HERE, "study.toml"), "--quick"]
        cls.answer = subprocess.run(command, capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def test_everything_converged(self):
        self.assertEqual(self.answer.returncode, 0, self.answer.stderr)

    def test_designs_are_side_by_side(self):
        start, nominal, robust = json.loads(self.read("results.json"))["designs"]
        self.assertEqual([start["name"], nominal["name"], robust["name"]], ["start", "nominal optimum", "robust optimum"])
        self.assertEqual(start["parameters"]["geometry.flank_angle_deg"], 50)
        self.assertEqual(len(robust["limits"]), 5)
        for design in (start, nominal, robust):
            # A larger force wears more, and no sample more than the worst corner.
            weak, strong = (at["worst_volume_m3"] for at in design["over_force"])
            self.assertGreater(strong, weak)
            self.assertLessEqual(design["worst_volume_in_samples_m3"], 1.02 * design["worst_volume_m3"])
            self.assertEqual(design["over_force"][-1]["force_n"], 5)
            self.assertAlmostEqual(strong / design["worst_volume_m3"], 1, delta=1e-9)

    def test_tables_and_page(self):
        rows = list(csv.reader(self.read("designs.csv").splitlines()))
        self.assertEqual([len(row) for row in rows], [9] * 4)
        page = self.read("report.html")
        self.assertEqual(page.count("<svg xmlns"), 2)
        self.assertIsNone(re.search(r'<(script|link|img)\b|src="|href="http', page))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
