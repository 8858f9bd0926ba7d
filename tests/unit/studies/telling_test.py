"""What commands tell of their work, on a terminal, in logs, or not at all:  telling_test.py PROGRAM"""
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile

from coarse_runs import VARIABLES, coarse_study

program = str(pathlib.Path(sys.argv[1]).resolve())
STUDY = VARIABLES + """[[objective]]
response = "peak_amplitude_m"
[optimizer]
max_evaluations = 3
scan_evaluations = 3
finer_meshes = 0
verify = 0
departures = false
"""


def answer(*arguments, status=0):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done


def on_a_terminal(*arguments):
    """All that a terminal gets."""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(program, [program, *arguments])
    text = b""
    while True:
        try:
            part = os.read(terminal, 65536)
        except OSError:  # nobody has it open any more
            break
        if not part:
            break
        text += part
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert status == 0, (arguments, status, text)
    return text.decode()


with tempfile.TemporaryDirectory() as name:
    os.chdir(name)
    coarse_study(program, pathlib.Path("."), STUDY)
    answer("run", "study.toml", "-o", "out", "--quiet")

    for command in (["check", "study.toml"], ["reduce", "study.toml", "-o", "m.h5"],
                    ["export", "m.h5", "--format", "matrix-market", "-o", "m.toml"],
                    ["import", "m.toml", "-o", "again.h5"], ["export", "out", "--format", "csv", "-o", "c.csv"],
                    ["export", "study.toml", "--format", "vtu", "-o", "s.vtu"], ["export", "out", "--format", "dxf", "-o", "o.dxf"],
                    ["report", "out", "-o", "r.html"], ["merge", "out", "-o", "merged"]):
        log = pathlib.Path(f"{command[0]}.jsonl")
        before = len(log.read_text().splitlines()) if log.exists() else 0
        done = answer(*command, "--json-log", str(log))
        assert done.stderr == "" and done.stdout, (command, done.stderr)
        events = [json.loads(line) for line in log.read_text().splitlines()[before:]]
        assert (events[0]["event"], events[0]["command"]) == ("begin", command[0]), events
        assert (events[-1]["event"], events[-1]["exit_status"]) == ("end", 0), events
        assert len(events) > 2 and all(event["event"] == "stage" and event["what"] for event in events[1:-1]), events
        assert all(a["seconds"] <= b["seconds"] for a, b in zip(events, events[1:])), events

    # A log goes on; what is none is left alone.
    text = pathlib.Path("study.toml").read_text()
    done = answer("check", "study.toml", "--json-log", "study.toml", status=2)
    assert done.stderr == "--json-log = study.toml: exists, and is no log that could be gone on with\n", done.stderr
    assert pathlib.Path("study.toml").read_text() == text
    assert answer("check", "study.toml", "--json-log", "-", status=2).stderr == "--json-log = -: must be a file\n"
    assert "cannot be written" in answer("check", "study.toml", "--json-log", "missing/l.jsonl", status=2).stderr

    # What is refused has an end, too.
    answer("run", "study.toml", "-o", "refused", "--set", "contact.friction=-1", "--json-log", "run.jsonl", status=2)
    assert [json.loads(line)["event"] for line in pathlib.Path("run.jsonl").read_text().splitlines()] == ["begin", "end"]
    answer("merge", "out", "none", "-o", "not-merged", "--json-log", "refused.jsonl", status=2)
    assert [json.loads(line)["exit_status"] for line in pathlib.Path("refused.jsonl").read_text().splitlines()[-1:]] == [2]
    assert not pathlib.Path("not-merged").exists()

    # Warnings and remarks are nothing for who asked for quiet; errors are.
    doubtful = ["check", "study.toml", "--set", "geometry.sectors=90"]
    assert "warning: " in answer(*doubtful).stderr
    assert answer(*doubtful, "--quiet").stderr == ""
    assert answer(*doubtful, "--quiet", "--strict", status=2).stderr != ""
    assert answer("reduce", "out", "-o", "m.h5", "--quiet").stderr == ""
    fine = ["reduce", "study.toml", "-o", "fine.h5", "--set", "mesh.flank_elements=300"]
    said = on_a_terminal(*fine)
    assert re.search(r"\r\x1b\[Kdovetail: the reduced model: \d+ s", said), said
    assert re.search(r"\r\x1b\[Kfine.h5: [^\r]*\r\n$", said), said  # no progress is left behind
    assert on_a_terminal(*fine[:4], "--quiet").startswith("fine.h5: "), "quiet is not"
    assert "dovetail: " not in on_a_terminal("check", "study.toml"), "short work tells of itself"
print("told")
