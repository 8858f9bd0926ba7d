#!/usr/bin/env python3
"""Runs the study in its quick form and checks its files:  check.py PATH_OF_ROBUST_JOINT"""
import csv
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ready_study"))
import quick_run  # noqa: E402


class Robust(quick_run.QuickRun):
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

    def test_searches_look_where_they_say(self):
        for name, cases in (("nominal", 1), ("robust", 9)):
            journal = self.read(os.path.join(name, "journal.jsonl")).splitlines()[1:]
            answers = [json.loads(line)["record"]["responses"] for line in journal]
            seen = {key.partition("@")[2] for responses in answers for key in responses if "@" in key}
            self.assertEqual(len(seen), cases, (name, seen))

    def test_page_says_what_the_data_say(self):
        designs = json.loads(self.read("results.json"))["designs"]
        page = self.read("report.html").replace("\u2212", "-")
        start, nominal, robust = designs
        lead = page.partition('class="lead">')[2].partition("</p>")[0]
        for other, name in ((start, "the start"), (nominal, "the nominal optimum")):
            part = 1 - robust["worst_volume_m3"] / other["worst_volume_m3"]
            self.assertIn(f"{100 * abs(part):.0f} % {'more' if part < 0 else 'less'} than {name}", lead)
        # A row for each limit: every design at its worst corner, and in brackets in the samples.
        rows = [row.split("<td") for row in page.split("<tr") if "%" in row and "(" in row]
        for name in robust["limits"]:
            cells = [(f"{100 * d['limits'][name]['value']:+.1f} %", f"({100 * d['limits_in_samples'][name]:+.1f} %)") for d in designs]
            found = [row for row in rows if len(row) > 3 and all(a in cell and b in cell for (a, b), cell in zip(cells, row[-3:]))]
            self.assertEqual(len(found), 1, (name, cells))
        table = list(csv.DictReader(self.read("designs.csv").splitlines()))
        for row, design in zip(table, designs):
            self.assertEqual(row["design"], design["name"])
            self.assertAlmostEqual(float(row["worst_volume_mm3"]) * 1e-9, design["worst_volume_m3"], delta=1e-4 * design["worst_volume_m3"])
            for key, value in design["parameters"].items():
                self.assertAlmostEqual(float(row[key]), value, delta=1e-6 * max(1, abs(value)))

    def test_tables_and_page(self):
        rows = list(csv.reader(self.read("designs.csv").splitlines()))
        self.assertEqual([len(row) for row in rows], [9] * 4)
        page = self.standing_alone()
        self.assertEqual(page.count('class="chart"'), 2)


if __name__ == "__main__":
    quick_run.main(__file__)
