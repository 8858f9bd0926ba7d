"""Nothing finished is lost, and a run ends with the same bits, whoever of it is killed and whenever.

KILLS=20 SEED=3 python3 killed_runs_test.py PROGRAM MPI_PROGRAM
"""
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

from coarse_runs import JOURNALS, coarse_study, kept, run

program, mpi_program = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", "3"]
# What an MPI library leaves allocated is not ours.
os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
# Ranks of one machine need no remote shell, and a bare machine has none.
os.environ["OMPI_MCA_plm_rsh_agent"] = "/bin/true"
random.seed(int(os.environ.get("SEED", "1")))
COMMANDS = {"program": [program], "ranks": [*MPIRUN, mpi_program]}
OPTIONS = {"program": ["--jobs", "2"], "ranks": []}


def children(process):
    listed = subprocess.run(["pgrep", "-P", str(process)], capture_output=True, text=True).stdout
    return [int(child) for child in listed.split()]


def finished_lines(directory):
    """Lines that were written to their end. Of a torn one nothing was finished."""
    texts = {name: (directory / name).read_bytes() for name in JOURNALS if (directory / name).exists()}
    return {name: text[: text.rfind(b"\n") + 1].splitlines() for name, text in texts.items()}


def killed(folder, out, kind, after, options=()):
    """Whether a run was killed that many seconds after it began; whoever is left of it has ended, too."""
    job = subprocess.Popen([*COMMANDS[kind], "run", "study.toml", "-o", out, *OPTIONS[kind], *options], cwd=folder,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(after)
    victims = children(job.pid) if kind == "ranks" else [job.pid]
    workers = children(job.pid) if kind == "program" else []
    hit = job.poll() is None and bool(victims)
    if hit:
        os.kill(random.choice(victims), signal.SIGKILL)
    job.wait()
    deadline = time.monotonic() + 10
    while any(pathlib.Path(f"/proc/{worker}").exists() for worker in workers) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(pathlib.Path(f"/proc/{worker}").exists() for worker in workers), "a worker outlives its run"
    return hit


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    coarse_study(program, folder)
    seconds, alone = {}, None
    for kind in COMMANDS:
        begin = time.monotonic()
        whole = run(folder, f"whole_{kind}", COMMANDS[kind], OPTIONS[kind])
        seconds[kind] = time.monotonic() - begin
        assert alone is None or whole == alone, kind
        alone = whole
    hits = 0
    for attempt in range(int(os.environ.get("KILLS", "4"))):
        kind = random.choice(list(COMMANDS))
        out, directory = f"killed{attempt}", folder / f"killed{attempt}"
        before = {}
        # Some are killed again while they go on.
        for time_of_death in range(random.choice((1, 1, 2))):
            options = ["--resume"] if time_of_death > 0 else []
            hits += killed(folder, out, kind, random.uniform(0, seconds[kind]), options)
            now = finished_lines(directory)
            for journal, lines in before.items():
                assert now[journal][: len(lines)] == lines, (attempt, journal)
            before = now
        resumed = run(folder, out, COMMANDS[kind], [*OPTIONS[kind], "--resume"])
        assert resumed == alone, (attempt, kind)
        after = finished_lines(directory)
        for journal, lines in before.items():
            assert after[journal][: len(lines)] == lines, (attempt, journal)
    assert hits > 0, "nothing was killed"
print(f"the same bits after {hits} deaths")
