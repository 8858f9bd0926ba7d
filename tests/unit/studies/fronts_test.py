"""A front of a study with cases, a mission and linked keys: its files agree with each other and with single evaluations of its
points, for any number of processes, and go on with more evaluations.

python3 fronts_test.py PROGRAM
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

from coarse_runs import CASES, VARIABLES, coarse_study, records

program = str(pathlib.Path(sys.argv[1]).resolve())
STUDY = CASES + VARIABLES + """[[linked]]
key = "geometry.shank_width_mm"
value = "geometry_neck_width_mm + 2.5"
[[objective]]
response = "mission_wear_volume_m3"
[[objective]]
response = "peak_amplitude_m"
over = "hard"
[[objective]]
response = "mission_drift"
aim = -0.001
[[constraint]]
response = "peak_amplitude_m"
upper = 13e-3
[optimizer]
algorithm = "nsga2"
population = 8
max_evaluations = 16
front_points = 3
finer_meshes = 0
noise = 0.01
verify = 0
departures = false
"""
OBJECTIVES = ("mission_wear_volume_m3", "peak_amplitude_m@hard", "|mission_drift + 0.001|")


def run(folder, out, *options):
    done = subprocess.run([program, "run", "study.toml", "-o", out, *options], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, (out, done.returncode, done.stderr[-2000:])
    return done.stdout


def front(directory):
    with open(directory / "front.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    coarse_study(program, folder, STUDY)
    said = run(folder, "alone", "--jobs", "1")
    assert run(folder, "jobs", "--jobs", "3").replace("jobs", "alone") == said
    points = front(folder / "alone")
    assert points == front(folder / "jobs") and len(points) >= 2, len(points)
    for name in ("journal.jsonl", "front.jsonl"):
        assert sorted(map(str, records(folder / "alone" / name))) == sorted(map(str, records(folder / "jobs" / name))), name

    def objectives(row):
        return [float(row[f"objective {name}"]) for name in OBJECTIVES]

    for row in points:
        # No point beats another, and each keeps its limit.
        for other in points:
            assert row is other or any(a < b for a, b in zip(objectives(row), objectives(other))), (row, other)
        assert float(row["constraint peak_amplitude_m:upper"]) <= 0, row
        drifts = [float(row[f"mission_drift@{case}"]) for case in ("plain", "hard")]
        worst = max(abs(drift + 0.001) for drift in drifts)
        assert abs(objectives(row)[2] - worst) <= 1e-12, row
        # What all cases wear off together is one number of them all.
        assert row["mission_wear_volume_m3@plain"] == row["mission_wear_volume_m3@hard"] == row["mission_wear_volume_m3"]
    # A point's study is the point: what follows from the variables stands in it.
    for row in (points[0], points[-1]):
        command = [program, "evaluate", str(folder / "alone" / row["study"]), "--no-bars", "--no-history", "--json", "-"]
        answer = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        neck = float(row["geometry.neck_width_mm"])
        assert abs(answer["parameters"]["geometry.shank_width_mm"] - (neck + 2.5)) < 1e-12, answer["parameters"]
        for response in ("mission_wear_volume_m3", "peak_amplitude_m@hard", "mission_drift@plain"):
            plain, _, case = response.partition("@")
            value = (answer["cases"][case]["responses"] if case else answer["responses"])[plain]
            assert abs(value - float(row[response])) <= 1e-8 * abs(value), (response, value, row[response])
    # Bars of the points spread over the front, and of none beside them and the compromise.
    barred = [row for row in points if row["objective mission_wear_volume_m3_bar"]]
    assert min(3, len(points)) <= len(barred) <= 4, len(barred)
    # With more evaluations it goes on.
    text = (folder / "study.toml").read_text()
    (folder / "study.toml").write_text(text.replace("max_evaluations = 16", "max_evaluations = 24"))
    longer = run(folder, "alone", "--jobs", "2", "--resume")
    assert "16 of them stored before" in longer and "not asked for again" not in longer, longer
    assert len(records(folder / "alone" / "journal.jsonl")) == 25
print("a front with cases, a mission and linked keys holds together")
