"""Programs to measure: built from commits and working trees, run for times and under valgrind for instruction counts."""

import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLACE = ROOT / "build-compare"  # ignored by git
SOURCE = "tests/benchmarks/stage_benchmark.cpp"
# Counts are those of one thread, and of kernels that every processor of the last ten years has.
COUNTED = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Haswell"}


class UsageError(Exception):
    """One sentence for the user."""


@dataclasses.dataclass
class Subject:
    """What is measured: its name for people, and the program once it is built."""
    name: str
    source: pathlib.Path | None
    folder: pathlib.Path | None
    commit: str | None = None
    program: pathlib.Path | None = None


def git(*arguments):
    if not shutil.which("git"):
        raise UsageError("git is not installed; commits are found and built with it (Debian: apt-get install git).")
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)


def subject(given):
    """A commit, the folder of a working tree, or a stage_benchmark that is built."""
    path = pathlib.Path(given)
    if path.is_dir():
        if not (path / SOURCE).is_file():
            raise UsageError(f"{given} has no {SOURCE}: it is no working tree that can be compared.")
        place = path.resolve()
        folder = PLACE / f"tree-{hashlib.sha1(str(place).encode()).hexdigest()[:8]}"
        return Subject(str(place), place, folder)
    if path.is_file() and os.access(path, os.X_OK):
        return Subject(given, None, None, program=path.resolve())
    found = git("rev-parse", "--verify", "--quiet", "--end-of-options", given + "^{commit}")
    if found.returncode:
        raise UsageError(f"{given} is no commit of this repository, and no folder or program either.")
    commit = found.stdout.strip()
    if git("cat-file", "-e", f"{commit}:{SOURCE}").returncode:
        raise UsageError(f"{given} has no {SOURCE}: stages can be compared from the commit on that brought it.")
    return Subject(given, PLACE / commit[:12] / "source", PLACE / commit[:12], commit)


def build(what, jobs, cmake_options):
    """Builds the program of a subject unless it is there."""
    if what.program:
        return
    if what.commit and not what.source.is_dir():
        git("worktree", "prune")
        added = git("worktree", "add", "--detach", str(what.source), what.commit)
        if added.returncode:
            raise UsageError(f"git worktree add {what.source} failed: {added.stderr.strip()}")
    target = what.folder / "build"
    log = what.folder / "build.log"
    what.folder.mkdir(parents=True, exist_ok=True)
    print(f"building {what.name} in {target}", flush=True)
    with open(log, "w", encoding="utf-8") as out:
        for command in (["cmake", "-S", what.source, "-B", target, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                         "-DDOVETAIL_BUILD_TESTS=OFF", *cmake_options],
                        ["cmake", "--build", target, "--target", "stage_benchmark", "-j", str(jobs)]):
            if subprocess.run(command, stdout=out, stderr=out, check=False).returncode:
                raise UsageError(f"{what.name} does not build, see {log}.")
    what.program = target / "tests/benchmarks/stage_benchmark"


def clean():
    shutil.rmtree(PLACE, ignore_errors=True)
    if shutil.which("git"):
        git("worktree", "prune")  # those that are no longer there


def options(scenes, stages):
    result = []
    if scenes:
        result += ["--scenes", ",".join(scenes)]
    if stages:
        result += ["--stages", ",".join(stages)]
    return result


def run(command, environment, answer):
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | environment, check=False)
    if done.returncode:
        tail = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise UsageError(f"{' '.join(map(str, command))} ended with {done.returncode}: {' '.join(tail)}")
    return json.loads(pathlib.Path(answer).read_text(encoding="utf-8"))


def times(program, scenes, stages, repetitions):
    """Processor seconds of one run, (scene, stage): list."""
    with tempfile.TemporaryDirectory() as folder:
        answer = pathlib.Path(folder) / "answer.json"
        figures = run([program, "--no-limits", "--repetitions", str(repetitions), *options(scenes, stages), "--json",
                       answer], {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}, answer)
    return {(scene, stage): of["seconds"] for scene, found in figures["scenes"].items()
            for stage, of in found["stages"].items()}


def require_valgrind():
    if not shutil.which("valgrind"):
        raise UsageError("valgrind is not installed; instructions are counted with it (Debian: apt-get install valgrind).")


def counts_of_scene(program, scene, stages, limits):
    """The program's answer on a scene, and its counts by stage or kernel."""
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        command = ["valgrind", "--tool=callgrind", "--toggle-collect=dovetail_counted",
                   "--dump-after=dovetail_counted", f"--callgrind-out-file={place / 'out'}", program, "--once",
                   *options([scene], stages), "--json", place / "answer.json"]
        answer = run(command + ([] if limits else ["--no-limits"]), COUNTED, place / "answer.json")
        counted = {}
        for number, (_, work) in enumerate(answer["counted"], start=1):
            text = (place / f"out.{number}").read_text(encoding="utf-8", errors="replace")
            counted[work] = int(re.search(r"^totals: (\d+)", text, re.MULTILINE)[1])
    return answer, counted


def count(program, scenes, stages, limits, jobs):
    """Answers and counts by scene; several scenes at once, as counts do not depend on the load."""
    require_valgrind()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        asked = {scene: pool.submit(counts_of_scene, program, scene, stages, limits) for scene in scenes}
        return {scene: future.result() for scene, future in asked.items()}
