#!/usr/bin/env python3
"""Runs a study in its quick form and checks its files and findings:  check.py PATH_OF_PAPER_SEQUENCE STUDY.toml"""
import csv
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ready_study"))
import quick_run  # noqa: E402

FIGURES = ("nodal_diameters", "preload_pressure", "response", "dissipated_power", "first_cycle_rates",
           "depths_over_cycles", "rates_over_cycles", "volume_over_cycles", "final_profiles",
           "responses_while_wearing", "power_while_wearing", "amplitude_while_wearing", "resonance_while_wearing")
# On the coarse mesh as on the fine one; the symmetry of the section keeps the profiles from holding in full.
HOLDING = ("friction_damps", "power_peaks_at_resonance", "wear_comes_to_rest", "amplitude_falls_at_unworn_resonance",
           "peak_moves_down", "peak_grows")


class PaperSequence(quick_run.QuickRun):
    def test_every_figure_has_its_numbers(self):
        for name in FIGURES:
            rows = list(csv.reader(self.read(name + ".csv").splitlines()))
            self.assertIn(len(rows[0]), (3, 4), name)
            self.assertGreater(len(rows), 3, name)
            for row in rows[1:]:
                float(row[1])

    def test_findings(self):
        findings = {finding["key"]: finding for finding in json.loads(self.read("findings.json"))}
        self.assertEqual(len(findings), 9)
        for key in HOLDING:
            self.assertEqual(findings[key]["verdict"], "holds", findings[key])
        for finding in findings.values():
            self.assertNotRegex(finding["here"], r"\b(nan|inf)\b|\u2013")

    def test_findings_agree_with_the_data(self):
        data = json.loads(self.read("results.json"))
        first, last = data["states"][0], data["states"][-1]
        self.assertLess(last["peak_hz"], first["peak_hz"])
        self.assertGreater(last["peak_amplitude_m"], first["peak_amplitude_m"])
        self.assertLess(last["amplitude_at_unworn_resonance_m"], first["amplitude_at_unworn_resonance_m"])
        self.assertLess(data["resonance_amplitude_m"], data["glued_amplitude_m"])
        rates = data["history"]["rate_m_per_cycle"]
        self.assertLess(max(rates[-1]), 0.01 * max(rates[0]))

    def test_page_stands_alone(self):
        page = self.standing_alone()
        self.assertEqual(page.count('class="chart"'), len(FIGURES))
        self.assertNotIn("were not computed", page)


if __name__ == "__main__":
    quick_run.main(__file__)
