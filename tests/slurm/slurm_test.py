#!/usr/bin/python3
"""Submits the job scripts of studies/slurm to a Slurm of one node, started for this and ended after it, and holds what they
end with against a run in one process. Exit status 77 where Slurm is not installed.

python3 slurm_test.py BUILD SCRIPTS
"""
import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "unit" / "studies"))
from coarse_runs import coarse_study, kept, run  # noqa: E402

BUILD, SCRIPTS = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
DAEMONS = ("munged", "slurmctld", "slurmd")
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
SECONDS = 400


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Slurm:
    """One node that says it has eight cores, whatever it has."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir(mode=0o700)
        key = folder / "munge" / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        user, host = getpass.getuser(), socket.gethostname().split(".")[0]
        conf = folder / "slurm.conf"
        conf.write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=1,sched_min_interval=0
SlurmdParameters=config_overrides
MpiDefault=none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=8 RealMemory=16000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
""")
        # As root MPI asks twice whether it is meant to be.
        self.environment = dict(os.environ, PATH=PATH, SLURM_CONF=str(conf), DOVETAIL_BUILD=str(BUILD),
                                OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_hwloc_base_binding_policy="none",
                                OMPI_MCA_rmaps_base_oversubscribe="1", ASAN_OPTIONS="detect_leaks=0")
        self.environment.pop("SLURM_JOB_ID", None)

    def __enter__(self):
        conf, munge = self.folder / "slurm.conf", self.folder / "munge"
        self.start("munged", "--foreground", "--force", f"--socket={munge}/socket", f"--key-file={munge}/key",
                   f"--pid-file={munge}/pid", f"--seed-file={munge}/seed", f"--log-file={munge}/log")
        self.wait("munged", lambda: (munge / "socket").exists(), 20)
        self.start("slurmctld", "-D", "-f", conf)
        self.start("slurmd", "-D", "-f", conf)
        self.wait("the node", lambda: self.ask("sinfo", "-h", "-o", "%t").strip() == "idle", 60)
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def start(self, name, *arguments):
        log = open(self.folder / f"{name}.out", "w", encoding="utf-8")
        command = [shutil.which(name, path=PATH), *map(str, arguments)]
        self.daemons.append(subprocess.Popen(command, stdout=log, stderr=log, env=self.environment))

    def ask(self, *command):
        return subprocess.run(command, capture_output=True, text=True, env=self.environment, check=False).stdout

    def wait(self, what, is_there, seconds):
        end = time.monotonic() + seconds
        while not is_there():
            if time.monotonic() > end:
                logs = "\n".join(f"{log}:\n{log.read_text(errors='replace')[-2000:]}" for log in sorted(self.folder.rglob("*log")) + sorted(self.folder.glob("*.out")))
                raise SystemExit(f"{what}: not there after {seconds} s\n{logs}")
            time.sleep(0.2)

    def submit(self, cwd, *arguments):
        done = subprocess.run(["sbatch", "--parsable", *arguments], cwd=cwd, capture_output=True, text=True, env=self.environment)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    def ends(self, job):
        """Waits for a job, or a part of one, and says how it ended."""
        self.wait(f"the end of job {job}", lambda: not self.ask("squeue", "-h", "-j", job).strip(), SECONDS)

    def cancel(self, job):
        self.ask("scancel", job)
        self.ends(job)


def logs(folder):
    return "\n".join(f"{log.name}:\n{log.read_text()[-1500:]}" for log in sorted(folder.glob("dovetail-*.log")))


if not all(shutil.which(name, path=PATH) for name in (*DAEMONS, "sbatch")):
    print("Slurm is not installed (slurmctld, slurmd, slurm-client, munge): nothing is submitted")
    sys.exit(77)
with tempfile.TemporaryDirectory(prefix="dovetail_slurm_") as name:
    root = pathlib.Path(name)
    folder = root / "work"
    folder.mkdir()
    coarse_study(BUILD / "dovetail", folder)
    alone = run(folder, "alone", [str(BUILD / "dovetail")], ["--jobs", "1"])
    with Slurm(root) as slurm:
        # The ranks of an MPI job; cancelled on the way, and submitted again.
        mpi = ("--ntasks=3", str(SCRIPTS / "mpi.sbatch"), "study.toml", "ranks")
        job = slurm.submit(folder, *mpi)
        slurm.wait("the first evaluations", lambda: (folder / "ranks/journal.jsonl").exists()
                   and len((folder / "ranks/journal.jsonl").read_text().splitlines()) > 2, SECONDS)
        slurm.cancel(job)
        before = (folder / "ranks/journal.jsonl").read_text()
        slurm.ends(slurm.submit(folder, *mpi))
        assert (folder / "ranks/results.h5").exists(), logs(folder)
        assert kept(folder / "ranks") == alone, logs(folder)
        after = (folder / "ranks/journal.jsonl").read_text()
        assert after.startswith(before[: before.rfind("\n") + 1]), "finished evaluations were lost"
        # Parts of the scan and all together, with a part that ended before it began.
        (folder / "parts/part-9").mkdir(parents=True)
        parts = slurm.submit(folder, "--array=1-3", str(SCRIPTS / "array.sbatch"), "study.toml", "parts")
        slurm.submit(folder, "--cpus-per-task=2", f"--dependency=afterany:{parts}", str(SCRIPTS / "merge.sbatch"), "study.toml", "parts")
        slurm.wait("the whole of the parts", lambda: not slurm.ask("squeue", "-h").strip(), SECONDS)
        for part in (1, 2, 3):
            lines = (folder / f"parts/part-{part}/journal.jsonl").read_text().splitlines()
            assert len(lines) == 1 + 1 + 2, (part, len(lines), logs(folder))  # header, start, two of six of the scan
        assert (folder / "parts/whole/results.h5").exists(), logs(folder)
        whole = kept(folder / "parts/whole")
        # The merged journal has the parts one after the other.
        order = lambda records: sorted(map(str, records))  # noqa: E731
        whole["journal.jsonl"], alone["journal.jsonl"] = order(whole["journal.jsonl"]), order(alone["journal.jsonl"])
        assert whole == alone, logs(folder)
print("job scripts end with the bits of a run in one process")
