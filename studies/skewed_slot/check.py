#!/usr/bin/env python3
"""Runs the study in its quick form and checks its files:  check.py PATH_OF_SKEWED_SLOT"""
import csv
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ready_study"))
import quick_run  # noqa: E402



class SkewedSlot(quick_run.QuickRun):
    def test_skew_raises_pressure_and_slip(self):
        straight, skewed = json.loads(self.read("results.json"))["joints"]
        self.assertEqual((straight["skew_deg"], skewed["skew_deg"]), (0, 20))
        # The normal forces balance the same centrifugal pull on flanks longer by 1/cos(20 degrees).
        self.assertAlmostEqual(skewed["pressure_mean_pa"] / straight["pressure_mean_pa"], 1, delta=0.1)
        self.assertGreater(skewed["pressure_max_pa"], 1.2 * straight["pressure_max_pa"])
        self.assertGreater(skewed["slip_max_m"], 1.2 * straight["slip_max_m"])

    def test_a_straight_slot_is_symmetric(self):
        straight = json.loads(self.read("results.json"))["joints"][0]
        half = len(straight["flank"]) // 2
        left, right = straight["pressure_pa"][:half], straight["pressure_pa"][half:]
        for a, b in zip(left, right):
            self.assertAlmostEqual(a, b, delta=0.01 * straight["pressure_max_pa"])

    def test_tables_and_page(self):
        rows = list(csv.reader(self.read("joints.csv").splitlines()))
        self.assertEqual(len(rows[0]), 6)
        self.assertGreater(len(rows), 40)
        page = self.standing_alone()
        self.assertEqual(page.count('class="chart"'), 6)


if __name__ == "__main__":
    quick_run.main(__file__)
