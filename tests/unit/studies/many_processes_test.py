"""A run gives the same bits with one process, with several, and with ranks of an MPI job; one that dies loses nothing.

python3 many_processes_test.py PROGRAM MPI_PROGRAM
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

program, mpi_program = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n"]
# What an MPI library leaves allocated is not ours.
os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
# Ranks of one machine need no remote shell, and a bare machine has none.
os.environ["OMPI_MCA_plm_rsh_agent"] = "/bin/true"
STUDY = """
[[case]]
name = "plain"
[[case]]
name = "hard"
"loading.tip_force_n" = 3
[[variable]]
key = "geometry.flank_mismatch_um"
lower = -5
upper = 20
[[variable]]
key = "geometry.neck_width_mm"
lower = 8
upper = 9.5
[[objective]]
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


def coarse_study(folder):
    subprocess.run([program, "new", "whole.toml"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    scene = (folder / "whole.toml").read_text().partition("# What the optimiser may change")[0]
    for key, value in {"flank_elements": 8, "fillet_fraction": 0.4, "bulk_size_mm": 6, "aerofoil_elements": 8, "harmonics": 3}.items():
        lines = [f"{key} = {value}" if line.startswith(f"{key} = ") else line for line in scene.splitlines()]
        assert lines != scene.splitlines(), key
        scene = "\n".join(lines)
    (folder / "study.toml").write_text(scene + STUDY)


def run(folder, name, command, options=()):
    done = subprocess.run([*command, "run", "study.toml", "-o", name, *options], cwd=folder, capture_output=True, text=True)
    assert done.returncode in (0, 3), (name, done.returncode, done.stderr[-2000:])
    return kept(folder / name)


def kept(directory):
    """What the files of a run say, without times."""

    def timeless(value):
        if isinstance(value, dict):
            return {key: timeless(part) for key, part in value.items() if key not in ("timings_s", "seconds", "checksum")}
        return [timeless(part) for part in value] if isinstance(value, list) else value

    found = {}
    for name in ("journal.jsonl", "finer.jsonl", "departures.jsonl", "verification.jsonl"):
        lines = [timeless(json.loads(line)) for line in (directory / name).read_text().splitlines()]
        # Verifications and departures are kept in the order in which they end.
        order = name in ("departures.jsonl", "verification.jsonl")
        lines = [{key: part for key, part in line.items() if key != "index"} for line in lines]
        for line in lines:
            if order and "record" in line:
                line["record"].pop("index", None)
        found[name] = sorted(lines, key=lambda line: json.dumps(line, sort_keys=True)) if order else lines
    found["best"] = (directory / "best.toml").read_text() if (directory / "best.toml").exists() else None
    return found


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    coarse_study(folder)
    alone = run(folder, "alone", [program], ["--jobs", "1"])
    assert len(alone["journal.jsonl"]) > 8, len(alone["journal.jsonl"])
    for jobs in (2, 3):
        assert run(folder, f"jobs{jobs}", [program], ["--jobs", str(jobs)]) == alone, jobs
    for ranks in (2, 4):
        assert run(folder, f"ranks{ranks}", [*MPIRUN, str(ranks), mpi_program]) == alone, ranks

    # Whoever dies: everything finished is there, and the rest is computed when the run is resumed.
    random.seed(int(os.environ.get("SEED", "1")))
    for attempt in range(int(os.environ.get("KILLS", "2"))):
        out = f"killed{attempt}"
        job = subprocess.Popen([*MPIRUN, "3", mpi_program, "run", "study.toml", "-o", out], cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        time.sleep(random.uniform(0.5, 4))
        ranks = [int(pid) for pid in subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True).stdout.split()]
        if ranks:
            os.kill(random.choice(ranks), signal.SIGKILL)
        job.wait()
        before = (folder / out / "journal.jsonl").read_text().splitlines() if (folder / out / "journal.jsonl").exists() else []
        resumed = run(folder, out, [program], ["--resume"])
        assert resumed == alone, attempt
        after = (folder / out / "journal.jsonl").read_text().splitlines()
        whole = [line for line in before if line == after[before.index(line)]]
        assert len(whole) >= len(before) - 1, (attempt, len(whole), len(before))
print("the same bits with processes and ranks, and after deaths")
