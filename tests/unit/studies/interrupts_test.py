"""Ctrl-C is answered at once, with what it waits for and what is kept:  interrupts_test.py PROGRAM"""
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from coarse_runs import coarse_study

program = str(pathlib.Path(sys.argv[1]).resolve())


class Job:
    """The program at work, with what it has said so far."""

    def __init__(self, folder, *arguments):
        self.said = folder / "said.txt"
        with self.said.open("w") as err:
            self.process = subprocess.Popen([program, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=err, text=True)

    def wait_for(self, words):
        deadline = time.monotonic() + 120
        while words not in self.said.read_text():
            assert self.process.poll() is None, (words, self.said.read_text())
            assert time.monotonic() < deadline, (words, self.said.read_text())
            time.sleep(0.01)

    def wait_until_it_handles(self):
        """Signals: before that the shell ends it as any program."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status")
        caught = 0
        while not caught & 1 << (signal.SIGINT - 1):
            time.sleep(0.01)
            caught = int(re.search(r"SigCgt:\s*(\w+)", status.read_text()).group(1), 16)

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    def end(self):
        """Exit status, answer and all that was said."""
        answer = self.process.communicate()[0]
        return self.process.returncode, answer, self.said.read_text()


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    coarse_study(program, folder)

    job = Job(folder, "run", "study.toml", "-o", "out", "--jobs", "1")
    job.wait_for("evaluation 3/10")
    job.interrupt()
    job.wait_for("Ctrl-C again to stop now")
    status, answer, said = job.end()
    assert status == 130, (status, said)
    assert re.search(r"dovetail: finishing evaluation \d+; Ctrl-C again to stop now\n", said), said
    assert re.search(r"interrupted; \d+ evaluations? kept in out; the same command with --resume goes on\n", said), said
    assert "describing" not in said and (folder / "out" / "best.toml").exists(), said

    job = Job(folder, "run", "study.toml", "-o", "twice", "--jobs", "1")
    job.wait_for("evaluation 2/10")
    job.interrupt()
    job.wait_for("Ctrl-C again to stop now")
    job.interrupt()
    status, answer, said = job.end()
    assert status == 130 and answer == "", (status, answer, said)
    assert re.search(r"dovetail: interrupted; \d+ evaluations? kept in twice; the same command with --resume", said), said
    assert not (folder / "twice" / "best.toml").exists()

    job = Job(folder, "run", "study.toml", "-o", "part", "--jobs", "1", "--part", "1/2")
    job.wait_for("evaluation 2/10")
    job.interrupt()
    status, answer, said = job.end()
    assert status == 130, (status, said)
    assert re.search(r": interrupted in part 1 of 2 of the scan: \d of its 4 evaluations are kept in part\n", answer), answer

    job = Job(folder, "evaluate", "study.toml")
    job.wait_until_it_handles()
    job.interrupt()
    status, answer, said = job.end()
    assert status == 130 and answer == "" and "dovetail: interrupted; nothing is written\n" in said, (status, answer, said)

    command = [program, "run", "study.toml", "-o", "out", "--resume"]
    whole = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert whole.returncode in (0, 3), whole.stderr
    if whole.returncode == 0:
        again = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        assert again.returncode == 0 and again.stdout == whole.stdout, again.stdout
        assert again.stderr == "dovetail: out: this run is finished; nothing is computed again\n", again.stderr
print("Ctrl-C is answered")
