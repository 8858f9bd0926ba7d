#!/usr/bin/env python3
"""Processor seconds of evaluations over random designs, against the median of their box.

    python3 tests/benchmarks/evaluation_times.py build/dovetail --designs 60 --seed 1

Two boxes: the variables of the quickstart ("design"), and a study's circumstances besides ("study"): friction, tip
force, damping, speed, titanium or nickel, flank angles of 40 to 55 degrees. Designs whose geometry is
impossible are drawn again. Prints one line per design and, per box, the median, the worst time over it and what the
evaluations came to. --csv FILE keeps the lines.
"""

import argparse
import collections
import csv
import json
import os
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tomllib

STUDY = pathlib.Path(__file__).resolve().parents[2] / "studies/quickstart/study.toml"

DESIGN = {v["key"]: (v["lower"], v["upper"]) for v in tomllib.loads(STUDY.read_text(encoding="utf-8"))["variable"]}
STUDY_BOX = DESIGN | {
    "geometry.flank_angle_deg": (40, 55),
    "contact.friction": (0.2, 0.8),
    "loading.tip_force_n": (0.5, 5),
    "loading.damping_ratio": (3e-4, 3e-3),
    "scene.speed_rpm": (8000, 12000),
}
NICKEL = {"youngs_modulus_gpa": 207, "poisson_ratio": 0.3, "density_kg_m3": 8200}


def draw(box, generator):
    settings = {key: round(generator.uniform(*bounds), 6) for key, bounds in box.items()}
    if "contact.friction" in box and generator.random() < 0.5:
        settings |= {f"material.{body}.{key}": value for body in ("blade", "disk") for key, value in NICKEL.items()}
    return settings


def evaluate(program, settings, extra, limit):
    """The answer and its processor seconds; an answer of its own where the time limit ends it."""
    command = [program, "evaluate", str(STUDY), "--json", "-"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    for setting in extra:
        command += ["--set", setting]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, timeout=limit, text=True, check=False,
                              env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
        if not done.stdout:
            sys.exit(f"{' '.join(command)}: exit status {done.returncode}\n{done.stderr}")
        answer = json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        answer = {"status": "not ended", "model": {}, "responses": {}, "error_estimates": {}}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return answer, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--designs", type=int, default=60, help="feasible designs per box")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--box", choices=("design", "study", "both"), default="both")
    parser.add_argument("--set", action="append", default=[], help="KEY=VALUE for all designs")
    parser.add_argument("--limit", type=float, default=900, help="wall seconds per evaluation")
    parser.add_argument("--csv")
    given = parser.parse_args()
    rows = []
    for name, box in (("design", DESIGN), ("study", STUDY_BOX)):
        if given.box not in (name, "both"):
            continue
        generator = random.Random(f"{name} {given.seed}")
        times, statuses = [], collections.Counter()
        while len(times) < given.designs:
            settings = draw(box, generator)
            answer, seconds = evaluate(given.program, settings, given.set, given.limit)
            if answer["status"] == "infeasible":
                continue
            times.append(seconds)
            statuses[answer["status"]] += 1
            model = answer["model"]
            row = {"box": name, "seconds": round(seconds, 2), "status": answer["status"]}
            for key in ("jacobians_spent", "wear_bearing_share", "wear_depth_over_compression", "penalty_ratio",
                        "nodal_wear_volume_m3"):
                row[key] = model.get(key)
            for key in ("asymptotic_wear_volume_m3", "asymptotic_wear_depth_max_m"):
                row[key] = answer["responses"].get(key)
            row["bar"] = answer["error_estimates"].get("asymptotic_wear_volume_m3")
            rows.append(row | settings)
            print(*(f"{value:.4g}" if isinstance(value, float) else value for value in row.values()),
                  json.dumps(settings), flush=True)
        median = statistics.median(times)
        print(f"{name}: median {median:.2f} s, longest {max(times):.2f} s = {max(times) / median:.1f} times; "
              + ", ".join(f"{count} {status}" for status, count in statuses.most_common()), flush=True)
    if given.csv:
        keys = list(dict.fromkeys(key for row in rows for key in row))
        with open(given.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, keys)
            writer.writeheader()
            writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
