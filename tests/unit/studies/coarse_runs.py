"""A study with cases, a mission and limits on a coarse mesh, in which a run takes seconds, and what a run of it keeps."""
import json
import subprocess

# What the studies of these tests vary, and the loads of those that have several.
VARIABLES = """
[[variable]]
key = "geometry.flank_mismatch_um"
lower = -5
upper = 20
[[variable]]
key = "geometry.neck_width_mm"
lower = 8
upper = 9.5
"""
CASES = """
[[case]]
name = "plain"
[[case]]
name = "hard"
"loading.tip_force_n" = 3
"""
STUDY = CASES + VARIABLES + """[[objective]]
response = "asymptotic_wear_volume_m3"
[[constraint]]
response = "peak_amplitude_m"
upper = 12e-3
[[constraint]]
response = "mission_wear_volume_m3"
upper = 5e-9
[optimizer]
algorithm = "cobyla"
scan_evaluations = 6
max_evaluations = 10
finer_meshes = 1
noise = 0.01
verify = 1
"""
COARSE = {"flank_elements": 8, "fillet_fraction": 0.4, "bulk_size_mm": 6, "aerofoil_elements": 8, "harmonics": 3}
# Verifications and departures are kept in the order in which they end.
UNORDERED = ("departures.jsonl", "verification.jsonl")
JOURNALS = ("journal.jsonl", "finer.jsonl", *UNORDERED)


def coarse_study(program, folder, study=STUDY, changes={}):
    """Writes study.toml into the folder: the coarse scene with changes of its keys, and what the study asks."""
    subprocess.run([program, "new", "whole.toml"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    scene = (folder / "whole.toml").read_text().partition("# What the optimiser may change")[0]
    for key, value in {**COARSE, **changes}.items():
        lines = [f"{key} = {value}" if line.startswith(f"{key} = ") else line for line in scene.splitlines()]
        assert lines != scene.splitlines(), key
        scene = "\n".join(lines)
    (folder / "study.toml").write_text(scene + study)


def run(folder, name, command, options=()):
    """What a run in folder/name, or the rest of one, ends with."""
    done = subprocess.run([*command, "run", "study.toml", "-o", name, *options], cwd=folder, capture_output=True, text=True)
    assert done.returncode in (0, 3), (name, done.returncode, done.stderr[-2000:])
    return kept(folder / name)


def records(journal):
    """Of a journal without times, checksums and places."""

    def timeless(value):
        if isinstance(value, dict):
            return {key: timeless(part) for key, part in value.items() if key not in ("timings_s", "seconds", "checksum")}
        return [timeless(part) for part in value] if isinstance(value, list) else value

    unordered = journal.name in UNORDERED
    lines = []
    for line in journal.read_text().splitlines():
        try:
            lines.append(timeless(json.loads(line)))
        except json.JSONDecodeError:
            # Of a line that a death cut short nothing was finished; here the next one stands behind it.
            assert unordered, line
    for line in lines:
        line.pop("index", None)
        line.get("record", {}).pop("index", None)
    if unordered:
        lines.sort(key=lambda line: json.dumps(line, sort_keys=True))
    return lines


def kept(directory):
    """What the files of a run say."""
    found = {name: records(directory / name) for name in JOURNALS}
    found["best"] = (directory / "best.toml").read_text() if (directory / "best.toml").exists() else None
    return found
