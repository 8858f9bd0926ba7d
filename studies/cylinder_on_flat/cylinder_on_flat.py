#!/usr/bin/env python3
"""Fretting wear of a steel cylinder on a flat in gross slip, against published computations.

McColl, Ding and Leen, "Finite element simulation and experimental validation of fretting wear", Wear 256 (2004): a
cylinder of 6 mm radius is pressed on a flat with 18.5 N per mm of length and rubbed by an imposed +-25 um; both wear.

    python3 cylinder_on_flat.py PATH_OF_DOVETAIL [-o FOLDER] [--quick]

writes the quasi-static model file, runs `dovetail wear --method history` on it, and two calculations of its own by
Archard's law on the same elastic half-planes: one on matched nodes as the program does, one that moves the pressure
over both surfaces through the stroke. FOLDER gets table.md, table.json, profiles.csv and model.h5.
"""
import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "model_file"))
from write_model import write_model

# Per metre of the cylinder's length, SI. Sources are in README.md.
RADIUS = 6e-3
LOAD = 18.5e3
STROKE = 25e-6  # imposed amplitude
MODULUS = 200e9
POISSON = 0.3
FRICTION = 0.8
WEAR = 3.33e-14  # 1/Pa, of each body
CYCLES = (1000, 5000, 10000, 18000)
PUBLISHED_DEPTH = (0.378e-6, 1.131e-6, 1.815e-6, 2.713e-6)  # of the flat
PUBLISHED_WIDTH = (0.22e-3, 0.36e-3, 0.43e-3, 0.52e-3)
PUBLISHED_SECONDS = 17000.0

COMPOSITE = MODULUS / (2 * (1 - POISSON**2))  # E*, both bodies of one steel
REFERENCE = RADIUS  # depth at which displacements count as rigid: fixes the logarithm of the half-plane
RIG = 1e13  # N/m per m: the imposed displacement acts through this spring, which gives way by 1.5 nm


class Settings:
    """Sizes of the computation. The first, Hertzian contact is 72 um wide."""

    def __init__(self, quick):
        self.spacing = 12.5e-6 if quick else 6.25e-6
        self.half_length = 0.3e-3
        self.cycles = (1000, 5000) if quick else CYCLES
        self.harmonics = 3 if quick else 7
        self.jump = 200 if quick else 25  # cycles per step of the calculations here
        # An explicit step must not wear a node by more than it is pressed in (worn_step), or pressures alternate.
        self.safety = 1.0

    @property
    def x(self):
        count = int(round(self.half_length / self.spacing))
        return self.spacing * np.arange(-count, count + 1)


def flexibility(x):
    """Displacement by piecewise-linear pressures, of both half-planes together: -(2/(pi E*)) int p ln|x - s| ds."""
    step = x[1] - x[0]

    def twice_integrated(t):
        size = np.where(t == 0, 1.0, np.abs(t))
        return np.where(t == 0, 0.0, 0.5 * t * t * np.log(size / REFERENCE) - 0.75 * t * t)

    t = x[:, None] - x[None, :]
    second = twice_integrated(t + step) - 2 * twice_integrated(t) + twice_integrated(t - step)
    return -2 / (np.pi * COMPOSITE) * second / step**2  # per nodal force (pressure times spacing)


def model(x, gap):
    """The model file's data sets: contact nodes, then the rigid approach and the rigid slide of the cylinder."""
    nodes = x.size
    step = x[1] - x[0]
    local = np.linalg.inv(flexibility(x))
    local = 0.5 * (local + local.T)
    n = 2 * nodes + 2
    stiffness = np.zeros((n, n))
    for direction in range(2):
        dofs = 2 * np.arange(nodes) + direction
        rigid = 2 * nodes + direction
        stiffness[np.ix_(dofs, dofs)] = local
        stiffness[dofs, rigid] = stiffness[rigid, dofs] = -local.sum(axis=1)
        stiffness[rigid, rigid] = local.sum()
    stiffness[n - 1, n - 1] += RIG
    static = np.zeros(n)
    static[n - 2] = LOAD
    cosine = np.zeros((1, n))
    cosine[0, n - 1] = RIG * STROKE
    output = np.zeros((1, n))
    output[0, n - 1] = 1
    return {
        "/mass": np.zeros((n, n)),
        "/damping": np.zeros((n, n)),
        "/stiffness": stiffness,
        "/contact/normal": 2 * np.arange(nodes),
        "/contact/tangential": (2 * np.arange(nodes) + 1).reshape(nodes, 1),
        "/contact/area": np.full(nodes, step),
        "/contact/gap": gap,
        "/contact/friction": np.full(nodes, FRICTION),
        "/contact/wear_coefficient": np.full(nodes, 2 * WEAR),  # depth counts both surfaces
        "/contact/position": np.column_stack([x, np.zeros(nodes), np.zeros(nodes)]),
        "/contact/group": np.zeros(nodes, dtype=np.int64),
        "/contact/slip_origin": np.zeros((nodes, 1)),
        "/force/static": static,
        "/force/cosine": cosine,
        "/force/sine": np.zeros((1, n)),
        "/output/vectors": output,
        "/output/names": ["slide"],
    }


def worn_step(settings):
    """Largest depth of an explicit step that pressures of alternating nodes survive, with the mean pressure at the end.

    Nodes that alternate (wavelength 2 h) are pressed in by p h/(pi E*) times 2; a step that wears more turns their
    difference round and makes it grow."""
    width = PUBLISHED_WIDTH[CYCLES.index(settings.cycles[-1])]
    return settings.safety * 2 * (2 * settings.spacing / (np.pi * COMPOSITE)) * LOAD / width


def by_program(program, folder, settings):
    """Depth of both surfaces together at the nodes after each number of cycles, and the processor seconds."""
    x = settings.x
    base = x**2 / (2 * RADIUS)
    depth = np.zeros_like(base)
    states, seconds, solves, done = [], 0.0, 0, 0
    path = os.path.join(folder, "model.h5")
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    for cycles in settings.cycles:
        write_model(path, model(x, base + depth))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [program, "wear", path, "--method", "history", "--frequency", "1", "--cycles", str(cycles - done),
                   "--increment", repr(worn_step(settings)), "--steps", "1000000",
                   "--harmonics", str(settings.harmonics), "--json", "-"]
        answer = subprocess.run(command, capture_output=True, text=True, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if answer.returncode != 0:
            sys.exit(f"{' '.join(command)} failed: {answer.stderr.strip()}")
        result = json.loads(answer.stdout)
        depth = depth + np.array(result["depth_m"])
        solves += result["solves"]
        done = cycles
        states.append(depth.copy())
        print(f"program: {cycles} cycles, {solves} steady states, {seconds:.1f} s", flush=True)
    write_model(path, model(x, base))  # the unworn one is kept
    return states, seconds, solves


def pressures(influence, gap, layer, loaded):
    """Nodal forces of a frictionless contact under LOAD whose nodes yield by `layer` times their force besides.

    `loaded` [n] is the first guess of what touches. Rows: flexibility f + gap = approach where f > 0."""
    loaded = loaded.copy()
    for _ in range(200):
        index = np.flatnonzero(loaded)
        size = index.size
        system = np.zeros((size + 1, size + 1))
        system[:size, :size] = influence[np.ix_(index, index)]
        system[np.arange(size), np.arange(size)] += layer[index]
        system[:size, size] = -1
        system[size, :size] = 1
        solution = np.linalg.solve(system, np.append(-gap[index], LOAD))
        force = np.zeros(gap.size)
        force[index] = solution[:size]
        above = influence[:, index] @ force[index] + gap - solution[size]
        now = np.where(loaded, force > 0, above < 0)
        if np.array_equal(now, loaded):
            return force, loaded
        loaded = now
    raise RuntimeError("the contact of the calculation by Archard's law did not settle")


def by_archard(settings, moving):
    """Depths (cylinder, flat) after each number of cycles, by implicit steps of `jump` cycles.

    Not moving: both bodies are always under the same pressure, as with matched nodes. Moving: the cylinder stands at
    offsets s one spacing apart from -stroke to stroke, and every offset has its own pressure on shifted
    surfaces. The stroke is a whole number of spacings."""
    x = settings.x
    influence = flexibility(x)
    step = settings.spacing
    shifts = int(round(STROKE / step)) if moving else 0
    offsets = np.arange(-shifts, shifts + 1)
    weight = np.ones(offsets.size)
    if moving:
        weight[[0, -1]] = 0.5
    weight *= 4 * STROKE / weight.sum()  # imposed path per cycle, m
    cylinder, flat = np.zeros_like(x), np.zeros_like(x)  # in the coordinate of each body
    loaded = np.abs(x) < 40e-6
    cycles, states = 0, []
    order = np.arange(offsets.size)
    given, _ = pressures(influence, x**2 / (2 * RADIUS), np.zeros_like(x), loaded)
    given = influence @ given
    for end in settings.cycles:
        while cycles < end:
            # The pressure falls as 1/width: short jumps first.
            jump = min(settings.jump, max(1, cycles // 20), end - cycles)
            for k in order:
                s = offsets[k]
                shifted = np.roll(flat, -s)  # what faces the cylinder's node i: flat node i + s
                # Full sliding displaces the surfaces by the friction coefficient times what the pressure does: the
                # half-planes take that off the imposed path.
                path = weight[k] * (1 - FRICTION * given / STROKE)
                worn = WEAR * jump * path / step  # depth of each body per nodal force
                force, loaded = pressures(influence, x**2 / (2 * RADIUS) + cylinder + shifted, 2 * worn, loaded)
                given = influence @ force
                cylinder += worn * force
                flat += np.roll(worn * force, s)
            order = order[::-1]  # there and back
            cycles += jump
        states.append((cylinder.copy(), flat.copy()))
    return states


def extent(x, depth):
    """Width of the scar: where it is deeper than 1 % of its middle, with its edges between nodes."""
    limit = 0.01 * depth.max()
    inside = np.flatnonzero(depth > limit)
    first, last = inside[0], inside[-1]

    def edge(a, b):
        return x[a] + (x[b] - x[a]) * (depth[a] - limit) / (depth[a] - depth[b])

    left = edge(first, first - 1) if first > 0 else x[0]
    right = edge(last, last + 1) if last + 1 < x.size else x[-1]
    return right - left


def section(x, depth):
    return float(depth.sum() * (x[1] - x[0]))


def rows(settings, program, matched, moved):
    x = settings.x
    result = []
    for i, cycles in enumerate(settings.cycles):
        at = CYCLES.index(cycles)
        half = program[i] / 2
        result.append({
            "cycles": cycles,
            "published": {"depth_m": PUBLISHED_DEPTH[at], "width_m": PUBLISHED_WIDTH[at]},
            "program": {"depth_m": float(half.max()), "width_m": extent(x, half), "section_m2": section(x, half)},
            "archard_matched": {"depth_m": float(matched[i][1].max()), "width_m": extent(x, matched[i][1]),
                                "section_m2": section(x, matched[i][1])},
            "archard_moving_flat": {"depth_m": float(moved[i][1].max()), "width_m": extent(x, moved[i][1]),
                                    "section_m2": section(x, moved[i][1])},
            "archard_moving_cylinder": {"depth_m": float(moved[i][0].max()), "width_m": extent(x, moved[i][0]),
                                        "section_m2": section(x, moved[i][0])},
        })
    return result


def implied_wear(row):
    """Wear coefficient of each body for which a parabolic scar of the published width and depth obeys Archard."""
    published = row["published"]
    return WEAR * 2 / 3 * published["width_m"] * published["depth_m"] / row["archard_matched"]["section_m2"]


def table(results):
    names = (("published", "published"), ("program", "dovetail"), ("archard_matched", "Archard, matched nodes"),
             ("archard_moving_flat", "Archard, moving, flat"), ("archard_moving_cylinder", "Archard, moving, cylinder"))
    lines = ["| cycles | " + " | ".join(name for _, name in names) + " |", "|---" * (len(names) + 1) + "|"]
    for row in results:
        cells = [f"{1e6 * row[key]['depth_m']:.3f} / {1e3 * row[key]['width_m']:.3f}" for key, _ in names]
        lines.append(f"| {row['cycles']} | " + " | ".join(cells) + " |")
    return "Depth of one body (um) / width of its scar (mm):\n\n" + "\n".join(lines) + "\n"


def conclusions(results, seconds, solves):
    last = results[-1]
    text = []

    def share(a, b):
        return f"{100 * (a / b - 1):+.1f} %"

    ours, paper = last["program"], last["published"]
    text.append(f"After {last['cycles']} cycles the program's scar is {share(ours['depth_m'], paper['depth_m'])} deep and "
                f"{share(ours['width_m'], paper['width_m'])} wide against the published one.")
    matched = last["archard_matched"]
    text.append(f"The calculation by Archard's law on matched nodes differs from the program by "
                f"{share(matched['depth_m'], ours['depth_m'])} in depth: what the program computes for this model is "
                "right; the rest is the model.")
    flat = last["archard_moving_flat"]
    text.append(f"Moving the pressure through the stroke makes the flat's scar {share(flat['depth_m'], matched['depth_m'])} "
                f"deep and {share(flat['width_m'], matched['width_m'])} wide: the part that matched nodes leave out.")
    first = results[0]
    text.append(f"It is larger while the contact is narrow: {share(first['archard_moving_flat']['depth_m'], first['archard_matched']['depth_m'])}"
                f" and {share(first['archard_moving_flat']['width_m'], first['archard_matched']['width_m'])} after "
                f"{first['cycles']} cycles.")
    remaining = share(flat["depth_m"], paper["depth_m"]), share(flat["width_m"], paper["width_m"])
    text.append(f"With it, {remaining[0]} of depth and {remaining[1]} of width are left after {last['cycles']} cycles.")
    implied = ", ".join(f"{implied_wear(row):.2e}" for row in results)
    text.append(f"Parabolic scars of the published sizes obey Archard's law with {implied} 1/Pa for each body; "
                f"{WEAR:.2e} was used.")
    text.append(f"The program took {seconds:.0f} s of processor time ({solves} steady states); the published computation "
                f"took {PUBLISHED_SECONDS:.0f} s.")
    return text


def main():
    parser = argparse.ArgumentParser(description="Cylinder on flat in gross slip against published computations.")
    parser.add_argument("program", help="path of the dovetail program")
    parser.add_argument("-o", "--output", default="results/cylinder_on_flat", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="coarse, and up to 5000 cycles")
    arguments = parser.parse_args()
    settings = Settings(arguments.quick)
    os.makedirs(arguments.output, exist_ok=True)
    program, seconds, solves = by_program(arguments.program, arguments.output, settings)
    begin = time.process_time()
    matched = by_archard(settings, moving=False)
    moved = by_archard(settings, moving=True)
    print(f"by Archard's law: {time.process_time() - begin:.1f} s", flush=True)
    results = rows(settings, program, matched, moved)
    sentences = conclusions(results, seconds, solves)
    with open(os.path.join(arguments.output, "table.md"), "w") as file:
        file.write(table(results) + "\n" + "\n".join(sentences) + "\n")
    with open(os.path.join(arguments.output, "table.json"), "w") as file:
        json.dump({"rows": results, "processor_seconds": seconds, "steady_states": solves,
                   "published_seconds": PUBLISHED_SECONDS, "wear_coefficient_per_pa": WEAR,
                   "implied_wear_coefficient_per_pa": [implied_wear(row) for row in results]}, file, indent=1)
    with open(os.path.join(arguments.output, "profiles.csv"), "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["x_m"] + [f"{name}_{cycles}_cycles_m" for cycles in settings.cycles
                                   for name in ("program_one_body", "moving_flat", "moving_cylinder")])
        for i, x in enumerate(settings.x):
            values = [x]
            for k in range(len(settings.cycles)):
                values += [program[k][i] / 2, moved[k][1][i], moved[k][0][i]]
            writer.writerow([f"{value:.9e}" for value in values])
    print(table(results) + "\n" + "\n".join(sentences))


if __name__ == "__main__":
    main()
