"""Studies drawn at random: whatever is asked together of a coarse joint is either refused with a sentence or answered, and
what a run keeps says the same in each of its files.

python3 random_studies_test.py PROGRAM [FIRST [COUNT [DIR]]]: studies FIRST, FIRST + 1, ...; DIR keeps those that fail.
"""
import csv
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib

from coarse_runs import JOURNALS, records

program = str(pathlib.Path(sys.argv[1]).resolve())
first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
count = int(sys.argv[3]) if len(sys.argv) > 3 else 8
keep = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else None

# What may stand in a message only where something went wrong inside.
FORBIDDEN = re.compile(r"terminate called|Sanitizer|runtime error:|std::|basic_string|vector::|map::at|(?<!= )\bnan\b|Assertion|bad_alloc")
# Ranges in which the quickstart's joint fits together, by keys of the study file.
VARIABLES = {"geometry.flank_mismatch_um": (-5, 25), "geometry.flank_crown_um": (-3, 10), "geometry.flank_angle_deg": (47, 55),
             "geometry.flank_length_mm": (5, 6), "geometry.neck_width_mm": (8, 9.5), "geometry.neck_fillet_radius_mm": (1.6, 2.5),
             "geometry.relief_length_mm": (0, 0.8), "geometry.relief_depth_um": (0, 8), "geometry.left.flank_mismatch_um": (-5, 25),
             "geometry.flank_edge_radius_mm": (0, 2), "geometry.aerofoil_span_mm": (95, 105), "contact.friction": (0.3, 0.7)}
CASE_KEYS = {"scene.speed_rpm": (7000, 13000), "loading.tip_force_n": (0.2, 6), "contact.friction": (0.1, 0.9),
             "loading.damping_ratio": (5e-4, 5e-3), "contact.wear_coefficient_per_pa": (0, 3e-13), "scene.mode": (1, 2),
             "geometry.flank_mismatch_um": (-5, 20), "geometry.platform_thickness_mm": (2.5, 4)}
WHOLE = ("scene.mode",)
# Responses with a number near the quickstart's, for limits and references.
RESPONSES = {"asymptotic_wear_volume_m3": 4e-10, "asymptotic_wear_depth_max_m": 3e-6, "initial_wear_rate_m3_per_cycle": 1e-16,
             "resonance_hz": 330, "worn_resonance_hz": 330, "resonance_drift": 1e-3, "peak_amplitude_m": 8e-3,
             "worn_peak_amplitude_m": 8e-3, "mass_kg": 0.15, "peak_stress_pa": 5e8, "contact_pressure_max_pa": 2e8,
             "contact_pressure_mean_pa": 7e7, "blade_fillet_stress_pa": 5e8, "disk_fillet_stress_pa": 4e8, "post_width_m": 1.1e-2,
             "mission_wear_volume_m3": 4e-10, "mission_wear_depth_max_m": 3e-6, "mission_drift": 1e-3}
ALGORITHMS = ("cobyla", "bobyqa", "neldermead", "sbplx", "isres", "direct_l", "crs2", "mma", "slsqp", "ipopt", "cmaes", "de", "nsga2",
              "scan")


class Draw(random.Random):
    """One study: the text of its parts."""

    def often(self, chance):
        return self.random() < chance

    def number(self, low, high, whole=False):
        return self.randint(low, high) if whole else float(f"{self.uniform(low, high):.4g}")

    def scene(self, text, solid):
        """The template's scene on a coarse mesh, with some other numbers."""
        changes = {"harmonics": self.choice((1, 2, 3, 3, 5)), "samples": self.choice((32, 64, 64, 128))}
        if solid:
            changes |= {"flank_elements": self.choice((2, 3, 4)), "slot_elements": self.choice((2, 3)), "aerofoil_elements": 4,
                        "bulk_size_mm": 20, "growth": 0.8, "fillet_fraction": 1, "skew_angle_deg": self.choice((0, 0, 12))}
        else:
            changes |= {"flank_elements": self.choice((2, 3, 5, 8, 8, 8, 12)), "fillet_fraction": 0.4, "bulk_size_mm": 6,
                        "aerofoil_elements": self.choice((6, 8))}
        if self.often(0.15):
            changes["follow"] = '"resonance"'
        if self.often(0.2):
            changes["tip_force_n"] = self.choice((1e-3, 0.3, 5, 12))
        if self.often(0.15):
            changes["wear_law"] = '"energy"'
            changes["energy_wear_coefficient_m3_per_j"] = 2e-13
        if self.often(0.15):
            changes["normal_stiffness_n_per_m3"] = 1e14
            changes["tangential_stiffness_n_per_m3"] = 1e14
        if self.often(0.1):
            changes["accuracy"] = self.choice((0.02, 0.1))
            changes["accuracy_work"] = 3
        if self.often(0.1):
            changes["prestress"] = '"shared"'
        if self.often(0.1):
            changes["max_jacobians"] = self.choice((20, 200, 2000))
        if self.often(0.15):
            changes["wear_coefficient_per_pa"] = 0
        for key, value in changes.items():
            open_to_choice = "# " if key == "prestress" else ""
            text, found = re.subn(rf"(?m)^{open_to_choice}{key} = [^#\n]*", f"{key} = {value}  ", text, count=1)
            assert found, key
        return text

    def table(self, what, **keys):
        lines = [f"[[{what}]]" if what in ("variable", "linked", "objective", "constraint", "case", "uncertain") else f"[{what}]"]
        for key, value in keys.items():
            if value is not None:
                lines.append(f"{key} = {json.dumps(value)}")
        return "\n".join(lines) + "\n"

    def asks(self, mission, cases, uncertain):
        """One response of objective or limit and what it goes over."""
        response = self.choice([r for r in RESPONSES if mission or not r.startswith("mission")])
        overs = ["worst"]
        # What all cases wear off together is one number of them all, and drifts are of each case.
        if not response.startswith("mission"):
            overs += ["mean", "sum", "quantile", "deviation"]
        if not response.startswith("mission_wear"):
            overs += cases
        return response, self.choice(overs) if (cases or uncertain) and self.often(0.5) else None

    def study(self, scenes):
        kind = "sector" if self.often(0.12) else "section"
        text = self.scene(scenes[kind], kind == "sector")
        cases = [f"case{i}" for i in range(self.choice((0, 0, 0, 1, 2, 2, 3)))]
        keys = self.sample(sorted(VARIABLES), self.choice((1, 2, 2, 3)))
        if "geometry.left.flank_mismatch_um" in keys and "geometry.flank_mismatch_um" in keys:
            keys.remove("geometry.flank_mismatch_um")
        for key in keys:
            low, high = VARIABLES[key]
            more = {"start": self.number(low, high)} if self.often(0.2) else {}
            text += self.table("variable", **{"key": key, "lower": low, "upper": high, **more})
        if "geometry.neck_width_mm" in keys and self.often(0.3):
            text += self.table("linked", key="geometry.shank_width_mm", value="geometry_neck_width_mm + 2.5")
        same = self.sample(sorted(CASE_KEYS), self.choice((1, 2)))
        for name in cases:
            changes = {f'"{key}"': self.number(*CASE_KEYS[key], key in WHOLE) for key in same if self.often(0.8)}
            weight = self.number(0.1, 5) if self.often(0.4) else None
            text += self.table("case", **{"name": name, "weight": weight, **changes})
        uncertain = self.often(0.25)
        if uncertain:
            for key in self.sample(("contact.friction", "loading.tip_force_n", "geometry.flank_mismatch_um", "scene.speed_rpm"),
                                   self.choice((1, 1, 2))):
                spread = {"relative": self.choice((0.05, 0.2))} if key != "geometry.flank_mismatch_um" else {"plus_minus": 2}
                text += self.table("uncertain", key=key, distribution=self.choice((None, "normal")), **spread)
            rule = self.choice(("corners", "sobol", "gauss", "nominal"))
            points = 4 if rule == "sobol" else 2 if rule == "gauss" else None
            text += self.table("robust", rule=rule, points=points, quantile=self.choice((None, 0.9)))
        algorithm = self.choice(ALGORITHMS)
        mission = self.often(0.3) and 'follow = "resonance"' not in text
        aims = 2 if algorithm == "nsga2" else self.choice((1, 1, 1, 2))
        weighted = aims > 1 and algorithm != "nsga2" and self.often(0.5)
        for _ in range(aims):
            response, over = self.asks(mission, cases, uncertain)
            aim = self.choice(("min", "max", "zero", RESPONSES[response]))
            text += self.table("objective", response=response, over=over, weight=self.number(0.5, 2) if weighted else None,
                               scale=RESPONSES[response] if weighted else None, aim=aim if self.often(0.3) else None,
                               reference=2 * RESPONSES[response] if aims > 1 and not weighted and self.often(0.3) else None)
        for _ in range(self.choice((0, 1, 1, 2, 3))):
            response, over = self.asks(mission, cases, uncertain)
            side = self.choice(("lower", "upper"))
            loose = self.choice((1, 1.5, 4)) if side == "upper" else self.choice((1, 0.7, 0.2))
            text += self.table("constraint", **{"response": response, "over": over, side: float(f"{loose * RESPONSES[response]:.3g}"),
                                                "scale": RESPONSES[response] if self.often(0.2) else None})
        evaluations = 2 if kind == "sector" else self.choice((1, 2, 4, 8))
        text += self.table("optimizer", algorithm=algorithm, max_evaluations=evaluations,
                           scan_evaluations=self.choice((0, 2, 4)), population=8 if algorithm == "nsga2" else None,
                           front_points=3, finer_meshes=self.choice((0, 0, 1, 2)), verify=self.choice((0, 0, 1, 2)),
                           departures=self.often(0.2), noise=self.choice((0.0, 0.02)), seed=self.randint(0, 9))
        if self.often(0.3):
            text += self.table("export", formats=self.sample(("dxf", "svg", "vtu", "csv", "inp", "pvd", "stl"), 2))
        return text


def kept(directory):
    """What the journals of a run say, without times."""
    return {name: records(directory / name) for name in JOURNALS if (directory / name).exists()}


class Study:
    """A drawn study in a folder, and what the program says of it."""

    def __init__(self, folder, text):
        self.folder = folder
        (folder / "study.toml").write_text(text)

    def ask(self, *words, allowed, seconds=600):
        done = subprocess.run([program, *words], cwd=self.folder, capture_output=True, text=True, timeout=seconds)
        said = done.stdout + done.stderr
        wrong = FORBIDDEN.search(said)
        assert done.returncode in allowed, (words, done.returncode, said[-3000:])
        assert not wrong, (words, wrong[0], said[-3000:])
        if done.returncode == 2:
            assert re.match(r"dovetail: |(study|odd)\.toml:(\d+:)? ", done.stderr), (words, done.stderr)
        return done

    def answer(self, *words, allowed):
        """The JSON that the program answers with on standard output."""
        done = self.ask(*words, "--json", "-", allowed=allowed)
        return json.loads(done.stdout, parse_constant=lambda word: word) if done.returncode != 2 else None


def over(rule, cases, values):
    """What values of the cases, less being better, come to; None where this oracle does not say."""
    weights = [weight for _, weight in cases]
    if rule in (None, "worst"):
        return max(values)
    if rule == "sum":
        return sum(w * v for w, v in zip(weights, values))
    if rule == "mean":
        return sum(w * v for w, v in zip(weights, values)) / sum(weights)
    names = [name for name, _ in cases]
    return values[names.index(rule)] if rule in names else None


def as_term(aim, response, value):
    if aim == "max":
        return -value
    if isinstance(aim, (int, float)):
        return abs(value - aim)
    return abs(value) if aim == "zero" or (aim is None and response.endswith("drift")) else value


def close(a, b):
    return abs(a - b) <= 1e-9 * max(abs(a), abs(b), 1e-300)


def check_table(study, lines):
    """The table's objective and limits are what its own responses of the cases come to."""
    cases = [(case["name"], case.get("weight", 1)) for case in study.get("case", [])] or [("", 1)]
    terms, limits = study.get("objective", []), study.get("constraint", [])
    for line in lines:
        if line["status"] != "converged":
            continue

        def values(response):
            return [float(line[f"{response}@{name}" if name else response]) for name, _ in cases]

        summands = []
        for term in terms:
            of_cases = [as_term(term.get("aim"), term["response"], value) for value in values(term["response"])]
            value = over(term.get("over"), cases, of_cases)
            summands.append(value if value is None else term.get("weight", 1) * value / term.get("scale", 1))
        front = len(terms) > 1 and "weight" not in terms[0]
        if None not in summands and not front:
            assert close(sum(summands), float(line["objective"])), ("objective", summands, line)
        broken = False
        for limit in limits:
            side = "upper" if "upper" in limit else "lower"
            sign = 1 if side == "upper" else -1
            rule = limit.get("over")
            value = over(rule, cases, [sign * value for value in values(limit["response"])])
            name = limit["response"] + (f"@{rule}" if rule not in (None, "worst") else "") + f":{side}"
            told = float(line[f"constraint {name}"])
            scaled = value if value is None else (value - sign * limit[side]) / limit.get("scale", abs(limit[side]))
            # Limits that this oracle does not know are believed.
            assert scaled is None or abs(scaled - told) <= 1e-9 * max(1, abs(told)), (name, scaled, told)
            broken = broken or told > 0
        if line["feasible"] == "true":
            assert not broken, ("feasible", line)


def check_best(study, lines, best, answer):
    """No feasible line of the table is better than the best design, and that one evaluated alone is its line."""
    feasible = [line for line in lines if line["feasible"] == "true"]
    variables = {key: value for key, value in best["variables"].items() if not key.endswith("start")}
    mine = [line for line in feasible if all(close(float(line[key]), value) for key, value in variables.items() if key in line)]
    assert mine, ("the best design is no line of the table", best)
    if len(study["objective"]) == 1 or "weight" in study["objective"][0]:
        least = min(float(line["objective"]) for line in feasible)
        # Looks on finer meshes may have corrected the limits, and then a better one of the search's mesh is refused.
        assert best["objective"] >= least - 1e-9 * abs(least), (best["objective"], least)
        assert any(close(float(line["objective"]), best["objective"]) for line in mine), (best["objective"], mine)
    compared = 0
    for column, text in mine[-1].items():
        response, _, case = column.partition("@")
        part = answer.get("cases", {}).get(case, {}) if case else answer
        value = part.get("responses", {}).get(response)
        if response in RESPONSES and text and value is not None:
            # A search that asks for nothing that vibrates lays contact nodes by what the preload opens, and they stay there:
            # a peak of pressure is then of other nodes, as near as its bar says, where it has one.
            moved = response == "contact_pressure_max_pa" and "resonance_hz" not in mine[-1]
            bar = part.get("error_estimates", {}).get(response, float("inf")) if moved else 0
            assert abs(float(text) - value) <= max(bar, 1e-6 * abs(value)), (column, text, value, bar)
            compared += 1
    assert compared >= 3, (compared, mine[-1])


def try_broken(draw, study):
    """A study with one odd value is refused with a sentence or answered."""
    whole = (study.folder / "study.toml").read_text()
    lines = whole.splitlines()
    for _ in range(4):
        index = draw.choice([i for i, line in enumerate(lines) if re.match(r"[\w\".]+ = ", line)])
        key = lines[index].partition(" = ")[0]
        odd = draw.choice(("nan", "-inf", "0", "-1", "1e300", "1e-300", "7", '""', '"x"', "true", "[]", "[1, 2]", "{}", "99999999999999999999",
                           "-0.0", '"../x"', "1_000", "0x7fffffff", "1979-05-27"))
        (study.folder / "odd.toml").write_text("\n".join([*lines[:index], f"{key} = {odd}", *lines[index + 1:]]) + "\n")
        checked = study.ask("check", "odd.toml", allowed=(0, 2))
        if checked.returncode == 2:
            assert "odd.toml" in checked.stderr, (key, odd, checked.stderr)
        elif not key.startswith(("mesh", "bulk", "flank_e", "slot_e", "aerofoil_e", "growth", "harm", "samp", "modes", "points")):
            study.ask("evaluate", "odd.toml", "--no-bars", "--unworn", allowed=(0, 2, 3))


def try_study(number, scenes, folder):
    """Its end in a word."""
    draw = Draw(number)
    study = Study(folder, draw.study(scenes))
    try_broken(draw, study)
    checked = study.ask("check", "study.toml", allowed=(0, 2))
    options = ("--jobs", str(draw.choice((1, 2))))
    ran = study.ask("run", "study.toml", "-o", "out", *options, allowed=(0, 2, 3))
    assert (ran.returncode == 2) == (checked.returncode == 2), ("check and run disagree", checked.stderr, ran.stderr)
    if ran.returncode == 2:
        return "refused"
    out = folder / "out"
    assert (out / "report.html").exists()
    once = kept(out)
    study.ask("export", "out", "--format", "csv", "-o", "all.csv", allowed=(0,))
    study.ask("report", "out", "-o", "again.html", allowed=(0,))
    told = study.answer("runs", "out", allowed=(0,))
    study.ask("run", "study.toml", "-o", "out", "--resume", allowed=(ran.returncode,))
    assert kept(out) == once, "a finished run that is resumed keeps something else"
    asked = tomllib.loads((folder / "study.toml").read_text())
    with open(folder / "all.csv", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    assert len(lines) <= asked["optimizer"]["max_evaluations"] + 1, len(lines)
    if "uncertain" not in asked:
        check_table(asked, lines)
    if (out / "best.toml").exists():
        answer = study.answer("evaluate", "out/best.toml", allowed=(0, 3))
        check_best(asked, lines, told["runs"][0], answer)
    if draw.often(0.3):
        # A run that is killed goes on to the same end.
        killed = subprocess.Popen([program, "run", "study.toml", "-o", "killed"], cwd=folder, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            killed.wait(draw.uniform(0.1, 1.5) * float(told["runs"][0]["seconds"] or 1))
        except subprocess.TimeoutExpired:
            os.killpg(killed.pid, signal.SIGKILL)
            killed.wait()
        study.ask("run", "study.toml", "-o", "killed", "--resume", allowed=(ran.returncode,))
        again = kept(folder / "killed")
        for name, records in once.items():
            assert again[name] == records, ("killed and resumed", name)
    study.ask("evaluate", "study.toml", "--no-bars", "--unworn", allowed=(0, 3))
    if ran.returncode == 0:
        return "done"
    why = ran.stderr.strip().splitlines()[-1]
    kinds = ("no feasible design", "could be computed", "verification", "looked at with bars")
    return "exit status 3: " + next((kind for kind in kinds if kind in why), why)


with tempfile.TemporaryDirectory() as root:
    scenes = {}
    for kind in ("section", "sector"):
        subprocess.run([program, "new", f"{kind}.toml", "--template", kind], cwd=root, check=True, stdout=subprocess.DEVNULL)
        scenes[kind] = (pathlib.Path(root) / f"{kind}.toml").read_text().partition("# What the optimiser may change")[0]
    ends, failures = {}, []
    for number in range(first, first + count):
        folder = pathlib.Path(root) / str(number)
        folder.mkdir()
        try:
            end = try_study(number, scenes, folder)
        except (AssertionError, subprocess.TimeoutExpired, json.JSONDecodeError) as error:
            end = "FAILED"
            failures.append(number)
            print(f"study {number}: {type(error).__name__}: {error}", flush=True)
            if keep:
                shutil.copytree(folder, keep / str(number), dirs_exist_ok=True)
        ends[end] = ends.get(end, 0) + 1
        print(number, end, flush=True)
        shutil.rmtree(folder)
    assert not failures, failures
    print(", ".join(f"{number} {end}" for end, number in sorted(ends.items())), "of", count, "studies")
