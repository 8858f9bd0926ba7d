"""A run gives the same bits with one process, with several, and with ranks of an MPI job.

python3 many_processes_test.py PROGRAM MPI_PROGRAM
"""
import os
import pathlib
import sys
import tempfile

from coarse_runs import coarse_study, run

program, mpi_program = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n"]
# What an MPI library leaves allocated is not ours.
os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
# Ranks of one machine need no remote shell, and a bare machine has none.
os.environ["OMPI_MCA_plm_rsh_agent"] = "/bin/true"

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    coarse_study(program, folder)
    alone = run(folder, "alone", [program], ["--jobs", "1"])
    assert len(alone["journal.jsonl"]) > 8, len(alone["journal.jsonl"])
    for jobs in (2, 3):
        assert run(folder, f"jobs{jobs}", [program], ["--jobs", str(jobs)]) == alone, jobs
    for ranks in (2, 4):
        assert run(folder, f"ranks{ranks}", [*MPIRUN, str(ranks), mpi_program]) == alone, ranks
print("the same bits with processes and ranks")
