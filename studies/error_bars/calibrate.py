#!/usr/bin/env python3
"""Do the error bars hold? Random designs at the default settings against settings that cost fifty times as much.

    python3 studies/error_bars/calibrate.py build/dovetail --designs 200 --seed 2 --lines section.jsonl

Every design is evaluated twice: as users do, with bars, and finely, where its responses count as the truth. One line
per design goes to the file as soon as it is there; the same command goes on where it was stopped. Then a table
says for each response how many of the true errors lie inside their bars, and how large both are in the median.
--table makes the table of such a file alone. --space takes a slice of a bladed disk in space.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tomllib

STUDIES = pathlib.Path(__file__).resolve().parents[1]

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
        "solver.max_jacobians": 0,
    },
}
SPACE = {
    "study": STUDIES / "bladed_disk_2009/study.toml",
    "box": {
        "geometry.flank_mismatch_um": (-5, 25),
        "geometry.flank_crown_um": (0, 10),
        "geometry.axial_crown_um": (0, 10),
        "geometry.flank_length_mm": (5, 6),
        "contact.friction": (0.3, 0.7),
        "loading.tip_force_n": (0.5, 4),
        "scene.speed_rpm": (8000, 12000),
    },
    "fine": {
        "mesh.flank_elements": 24,
        "mesh.slot_elements": 16,
        "mesh.aerofoil_elements": 24,
        "solver.harmonics": 5,
        "solver.samples": 256,
        "solver.modes": 40,
        "solver.max_jacobians": 0,
    },
}


def ranges(scene):
    variables = tomllib.loads(scene["study"].read_text(encoding="utf-8")).get("variable", [])
    return {v["key"]: (v["lower"], v["upper"]) for v in variables} | scene["box"]


def evaluate(program, study, settings, extra=()):
    command = [program, "evaluate", str(study), "--json", "-", *extra]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    if not done.stdout:
        raise RuntimeError(f"{' '.join(command)}: exit status {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def design(program, scene, seed, index):
    """The first design of this index whose geometry is possible, evaluated coarsely and finely."""
    generator = random.Random(f"{seed} {index}")
    while True:
        settings = {key: round(generator.uniform(*bounds), 6) for key, bounds in ranges(scene).items()}
        usual = evaluate(program, scene["study"], settings)
        if usual["status"] != "infeasible":
            break
    row = {"design": index, "status": usual["status"], "fine_status": "", "settings": json.dumps(settings),
           "seconds": usual["timings_s"]["total"], "fine_seconds": ""}
    if usual["status"] != "converged":
        return row
    fine = evaluate(program, scene["study"], settings | scene["fine"], ["--no-bars"])
    row |= {"fine_status": fine["status"], "fine_seconds": fine["timings_s"]["total"]}
    row["jacobians"] = usual["model"]["jacobians_spent"]
    row["messages"] = " | ".join(usual["messages"])
    row["sources"] = json.dumps(usual["error_sources"])
    for name, value in usual["responses"].items():
        row[name] = value
        row[name + ":bar"] = usual["error_estimates"].get(name, "")
        row[name + ":fine"] = fine["responses"].get(name, "")
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
    lines += ["", "| response | designs | inside | without a bar | median bar, % | median error, % | bar / error |",
              "|---|---|---|---|---|---|---|"]
    for name in [key[:-5] for key in (both[0] if both else {}) if key.endswith(":fine")]:
        bars, errors, scales, inside, without = [], [], [], 0, 0
        for row in both:
            if row[name + ":bar"] == "":
                without += 1
                continue
            bars.append(row[name + ":bar"])
            errors.append(abs(row[name] - row[name + ":fine"]))
            scales.append(abs(row[name + ":fine"]))
            # What both settings compute to the last digits (a mass) has no error.
            inside += errors[-1] <= bars[-1] + 1e-9 * scales[-1]
        if not bars:
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
    parser.add_argument("--seed", type=int, default=1, help="1 was used while the bars were built")
    parser.add_argument("--space", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--lines", default="error_bars.jsonl", help="one line per design, kept and gone on with")
    parser.add_argument("--table", action="store_true", help="the table of --lines alone")
    given = parser.parse_args()
    rows = read(given.lines)
    if not given.table:
        if not given.program:
            sys.exit("calibrate.py: the program is missing: build/dovetail")
        scene, done = SPACE if given.space else SECTION, {row["design"] for row in rows}
        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool, \
                open(given.lines, "a", encoding="utf-8") as file:
            started = [pool.submit(design, given.program, scene, given.seed, index)
                       for index in range(given.designs) if index not in done]
            for future in concurrent.futures.as_completed(started):
                row = future.result()
                rows.append(row)
                file.write(json.dumps(row) + "\n")
                file.flush()
                print(f"{len(rows)}/{given.designs} design {row['design']}: {row['status']} {row['seconds']:.1f} s, "
                      f"finely {row['fine_status']} {row['fine_seconds']} s", file=sys.stderr, flush=True)
    print(table(rows))


if __name__ == "__main__":
    main()
