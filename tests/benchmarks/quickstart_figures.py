#!/usr/bin/env python3
"""The figures that optimizer/accuracy.md and studies/quickstart/README.md give of the quickstart, measured again.

    bash studies/run quickstart
    python3 tests/benchmarks/quickstart_figures.py build/dovetail results/quickstart/best.toml

Start and best design with their bars: over meshes, and where one circumstance changes. About ten minutes on two cores.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess

START = pathlib.Path(__file__).resolve().parents[2] / "studies/quickstart/study.toml"
MESHES = (16, 24, 32, 48, 64, 128)
CIRCUMSTANCES = {
    "2 N": [],
    "0.5 N": ["loading.tip_force_n=0.5"],
    "5 N": ["loading.tip_force_n=5"],
    "friction 0.3": ["contact.friction=0.3"],
    "9 000 rpm": ["scene.speed_rpm=9000"],
    "11 000 rpm": ["scene.speed_rpm=11000"],
}
COLUMNS = {  # response: heading, unit
    "asymptotic_wear_volume_m3": ("volume, mm^3", 1e-9),
    "asymptotic_wear_depth_max_m": ("depth, um", 1e-6),
    "resonance_drift": ("drift, 1e-4", 1e-4),
    "peak_amplitude_m": ("amplitude, mm", 1e-3),
    "blade_fillet_stress_pa": ("blade fillet, MPa", 1e6),
    "disk_fillet_stress_pa": ("disk fillet, MPa", 1e6),
}


def evaluate(program, study, settings):
    command = [program, "evaluate", str(study), "--json", "-"]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    return json.loads(done.stdout)


def cell(answer, name, unit):
    if answer["status"] != "converged":
        return answer["status"]
    bar = answer["error_estimates"].get(name)
    return f"{answer['responses'][name] / unit:.4g} +- " + ("none" if bar is None else f"{bar / unit:.2g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("best")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    given = parser.parse_args()
    designs = {"start": START, "best": given.best}
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        def ask(settings):
            return {name: pool.submit(evaluate, given.program, study, settings) for name, study in designs.items()}
        meshes = {count: ask([f"mesh.flank_elements={count}"]) for count in MESHES}
        circumstances = {words: ask(settings) for words, settings in CIRCUMSTANCES.items()}
        for name in designs:
            print(f"\n{name}\n| edges | " + " | ".join(heading for heading, _ in COLUMNS.values()) + " | limits |")
            print("|---" * (len(COLUMNS) + 2) + "|")
            for count, answers in meshes.items():
                answer = answers[name].result()
                cells = [cell(answer, response, unit) for response, (_, unit) in COLUMNS.items()]
                kept = "kept" if answer["feasible"] else "broken"
                if answer["undecided_constraints"]:
                    kept += ", undecided: " + ", ".join(answer["undecided_constraints"])
                print(f"| {count} | " + " | ".join(cells) + f" | {kept} |", flush=True)
        print("\n| | start, mm^3 | best, mm^3 | start, mm | best, mm |\n|---|---|---|---|---|")
        for words, answers in circumstances.items():
            found = [answers[name].result() for name in designs]
            cells = [cell(a, response, unit) for response, unit in
                     (("asymptotic_wear_volume_m3", 1e-9), ("peak_amplitude_m", 1e-3)) for a in found]
            print(f"| {words} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
