#!/usr/bin/env python3
"""Do the error bars hold? Random designs at the default settings against settings that cost fifty times as much.

    python3 studies/error_bars/calibrate.py build/dovetail --designs 200 --seed 3 --lines results/section.jsonl

Every design is evaluated as users do, with bars, and held against its responses at fine settings, which count as the
truth. Truths that are known stand in section.csv and space.csv beside this program; missing ones are computed
(two or three minutes each) and added. One line per design goes to the file of lines as soon as it is there; the same command goes on
where it was stopped. Then a table says for each response how many of the true errors lie inside their bars, and how
large both are in the median. --table makes the table of such a file alone. --space takes a slice of a bladed disk.
"""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import threading
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
STUDIES = HERE.parent
# Fine settings take two or three minutes, in space up to 25; one section of 200 had no answer after an hour.
FINE_LIMIT_S = 3600
RESPONSES = (
    "asymptotic_wear_depth_max_m", "asymptotic_wear_volume_m3", "blade_fillet_stress_pa", "contact_pressure_max_pa",
    "contact_pressure_mean_pa", "disk_fillet_stress_pa", "dissipated_energy_j", "glued_frequency_hz",
    "initial_wear_rate_m3_per_cycle", "mass_kg", "neck_tension_pa", "peak_amplitude_m", "peak_stress_pa", "post_width_m",
    "resonance_drift", "resonance_hz", "worn_peak_amplitude_m", "worn_resonance_hz")

SECTION = {
    "study": STUDIES / "quickstart/study.toml",
    "box": {  # beside the variables of the study
        "contact.friction": (0.2, 0.8),
        "loading.tip_force_n": (0.5, 5),
        "loading.damping_ratio": (3e-4, 3e-3),
        "scene.speed_rpm": (8000, 12000),
    },
    "fine": {
        "mesh.flank_elements": 96,
        "mesh.fillet_fraction": 0.05,
        "mesh.blend_fraction": 0.2,
        "mesh.bulk_size_mm": 1.5,
        "mesh.aerofoil_elements": 48,
        "solver.harmonics": 15,
        "solver.samples": 512,
        "solver.modes": 60,
        "solver.max_jacobians": 5000,  # ten times the usual budget
    },
}
# Rough flanks: how stiff their asperities are spreads evenly over powers of ten; along the flank they yield more.
ROUGH = {
    "contact.normal_stiffness_n_per_m3": (13, 15.3),  # powers of ten
    "contact.tangential_stiffness_n_per_m3": (0.4, 1),  # of the normal one
}
SPACE = {
    "study": STUDIES / "bladed_disk_2009/study.toml",
    "box": {
        "geometry.flank_mismatch_um": (-5, 25),
        "geometry.flank_crown_um": (0, 10),
        "geometry.axial_crown_um": (0, 10),
        "geometry.flank_length_mm": (5, 6),
        "contact.friction": (0.3, 0.7),
        "loading.tip_force_n": (0.1, 0.8),  # with its low damping most joints slide as a whole at 1 N
        "scene.speed_rpm": (8000, 12000),
    },
    "fine": {
        "mesh.flank_elements": 12,
        "mesh.slot_elements": 12,
        "mesh.contact_slot_elements": 9,
        "mesh.aerofoil_elements": 17,
        "mesh.bulk_size_mm": 6,
        "mesh.fillet_fraction": 0.3,
        "mesh.blend_fraction": 0.5,
        "solver.harmonics": 5,
        "solver.samples": 256,
        "solver.modes": 40,
        "solver.max_jacobians": 5000,  # ten times the usual budget
    },
}


def ranges(scene):
    variables = tomllib.loads(scene["study"].read_text(encoding="utf-8")).get("variable", [])
    return {v["key"]: (v["lower"], v["upper"]) for v in variables} | scene["box"]


def columns(scene):
    return [*ranges(scene), *scene.get("rough", ())]


def asperities(rough, index):
    """The stiffness of rough flanks, drawn apart from the rest: the designs are the same as without it."""
    if not rough:
        return {}
    generator = random.Random(f"rough {index}")
    (normal_key, (low, high)), (tangential_key, shares) = rough.items()
    normal = float(f"{10 ** generator.uniform(low, high):.4g}")
    return {normal_key: normal, tangential_key: float(f"{normal * generator.uniform(*shares):.4g}")}


def evaluate(program, study, settings, extra=(), limit_s=None):
    command = [program, "evaluate", str(study), "--json", "-", *extra]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit_s,
                          env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    if not done.stdout:
        raise RuntimeError(f"{' '.join(command)}: exit status {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def draw(program, scene, seed, index):
    """The settings of the first design of this index whose geometry is possible, and what the program says of it."""
    generator = random.Random(f"{seed} {index}")
    while True:
        settings = {key: round(generator.uniform(*bounds), 6) for key, bounds in ranges(scene).items()}
        settings |= asperities(scene.get("rough"), index)
        usual = evaluate(program, scene["study"], settings, ["--no-bars"])
        if usual["status"] != "infeasible":
            return settings, usual


def true_values(program, scene, settings):
    """A row of the file of truths: settings and the responses at fine settings, the wear history asked where in doubt."""
    given = {key: repr(value) for key, value in settings.items()}
    try:
        fine = evaluate(program, scene["study"], settings | scene["fine"], ["--no-bars", *scene.get("extra", ())],
                        FINE_LIMIT_S)
    except subprocess.TimeoutExpired:
        return given | {"status": "out_of_time", "seconds": FINE_LIMIT_S}
    return {"status": fine["status"], "seconds": round(fine["timings_s"]["total"], 1)} | given | {
        name: f"{value:.9g}" for name, value in fine["responses"].items()}


class Truths:
    """The truths known so far, by design, in a file to which new ones are added as soon as they are there."""

    def __init__(self, path, scene):
        self.path, self.lock, self.rows = path, threading.Lock(), {}
        self.columns = ["seed", "design", "status", "seconds", *columns(scene), *RESPONSES]
        if path.exists():
            with path.open(encoding="utf-8", newline="") as file:
                for row in csv.DictReader(file):
                    self.rows[int(row["seed"]), int(row["design"])] = row

    def add(self, seed, index, row):
        row = {"seed": seed, "design": index} | {key: row.get(key, "") for key in self.columns[2:]}
        with self.lock:
            self.rows[seed, index] = row
            new = not self.path.exists()
            with self.path.open("a", encoding="utf-8", newline="") as file:
                writer = csv.DictWriter(file, self.columns, lineterminator="\n")
                if new:
                    writer.writeheader()
                writer.writerow(row)
        return row


def design(program, scene, truths, seed, index, judge):
    """What the program says of a design with its bars, beside the truth, which is computed where it is not known."""
    truth = truths.rows.get((seed, index))
    if truth is None:
        settings, usual = draw(program, scene, seed, index)
        found = {key: repr(value) for key, value in settings.items()}
        if usual["status"] == "converged":
            found = true_values(program, scene, settings)
        truth = truths.add(seed, index, found)
    settings = {key: float(truth[key]) for key in columns(scene)}
    if not judge:
        return {"design": index, "status": "not asked", "fine_status": truth["status"], "seconds": 0}
    usual = evaluate(program, scene["study"], settings | scene.get("judged", {}))
    row = {"design": index, "status": usual["status"], "seconds": usual["timings_s"]["total"], "fine_status": ""}
    if usual["status"] != "converged":
        return row
    if not truth["status"]:
        truth = truths.add(seed, index, true_values(program, scene, settings))
    row |= {"fine_status": truth["status"], "messages": usual["messages"], "sources": usual["error_sources"]}
    for name, value in usual["responses"].items():
        row[name] = value
        row[name + ":bar"] = usual["error_estimates"].get(name, "")
        row[name + ":fine"] = float(truth[name]) if truth[name] else ""
    return row


def read(path):
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.endswith("\n")]


def table(rows):
    states = {}
    for row in rows:
        key = row["status"] if row["status"] != "converged" else "converged, finely: " + row["fine_status"]
        states[key] = states.get(key, 0) + 1
    lines = [f"{count} designs: {state}" for state, count in sorted(states.items(), key=lambda s: -s[1])]
    both = [row for row in rows if row["status"] == row["fine_status"] == "converged"]
    doubts = [message for row in both for message in row["messages"] if "was in doubt" in message]
    decided = [re.search(r"ends with (\S+) m\^3, the direct method with (\S+) m\^3", message) for message in doubts]
    changes = sorted(abs(float(m[1]) / float(m[2]) - 1) for m in decided if m)
    lines.append(f"{len(doubts)} of {len(both)} worn states were in doubt; the wear history ended elsewhere in {len(changes)}")
    if changes:
        low, middle, high = (f"{100 * x:.2g}" for x in (changes[0], statistics.median(changes), changes[-1]))
        lines[-1] += f", by {low} to {high} %, {middle} % in the median"
    lines += ["", "| response | designs | inside | without a bar | median bar, % | median error, % | bar / error |",
              "|---|---|---|---|---|---|---|"]
    for name in [key[:-5] for key in (both[0] if both else {}) if key.endswith(":fine")]:
        bars, errors, scales, inside, without = [], [], [], 0, 0
        for row in both:
            if row[name + ":fine"] == "":
                continue
            if row[name + ":bar"] == "":
                without += 1
                continue
            bars.append(row[name + ":bar"])
            errors.append(abs(row[name] - row[name + ":fine"]))
            scales.append(abs(row[name + ":fine"]))
            # What both settings compute to the last digits (a mass) has no error; truths are kept with nine.
            inside += errors[-1] <= bars[-1] + 1e-8 * scales[-1]
        if not bars:
            if without:
                lines.append(f"| {name} | 0 |  | {without} |  |  |  |")
            continue
        scale = statistics.median(scales) or 1
        bar, error = statistics.median(bars), statistics.median(errors)
        lines.append(f"| {name} | {len(bars)} | {100 * inside / len(bars):.1f} % | {without} | {100 * bar / scale:.2g} | "
                     f"{100 * error / scale:.2g} | {bar / error if error else float('nan'):.1f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="build/dovetail")
    parser.add_argument("--designs", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="index of the first design")
    parser.add_argument("--seed", type=int, default=3, help="which have been looked at while the bars were built: see README.md")
    parser.add_argument("--space", action="store_true")
    parser.add_argument("--unworn", action="store_true", help="only responses of the unworn joint")
    parser.add_argument("--rough", action="store_true", help="the same designs with rough flanks")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="judge the bars at other settings than the study's, e.g. mesh.flank_elements=48")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--lines", default="results/error_bars.jsonl", help="one line per design, kept and gone on with")
    parser.add_argument("--table", action="store_true", help="the table of --lines alone")
    parser.add_argument("--truths", action="store_true", help="only compute the truths that are not known")
    given = parser.parse_args()
    pathlib.Path(given.lines).parent.mkdir(parents=True, exist_ok=True)
    rows = [] if given.truths else read(given.lines)
    if not given.table:
        if not given.program:
            sys.exit("calibrate.py: the program is missing: build/dovetail")
        scene, done = SPACE if given.space else SECTION, {row["design"] for row in rows}
        file = "space.csv" if given.space else "section.csv"
        if given.rough:
            scene, file = scene | {"rough": ROUGH}, "rough_" + file
        if given.unworn:
            scene, file = scene | {"extra": ["--unworn"]}, "unworn_" + file
        scene = scene | {"judged": dict(pair.split("=", 1) for pair in given.set)}
        truths = Truths(HERE / file, scene)
        indices = range(given.first, given.first + given.designs)
        if given.truths:
            done = {index for seed, index in truths.rows if seed == given.seed}
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            started = [pool.submit(design, given.program, scene, truths, given.seed, index, not given.truths)
                       for index in indices if index not in done]
            for future in concurrent.futures.as_completed(started):
                row = future.result()
                rows.append(row)
                if not given.truths:
                    with open(given.lines, "a", encoding="utf-8") as file:
                        file.write(json.dumps(row) + "\n")
                print(f"{len(rows)} of {given.designs}: design {row['design']}: {row['status']} {row['seconds']:.1f} s, "
                      f"finely {row['fine_status']}", file=sys.stderr, flush=True)
    if not given.truths:
        print(table(rows))


if __name__ == "__main__":
    main()
