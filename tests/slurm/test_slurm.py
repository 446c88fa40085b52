"""The workflow through a real Slurm, on a cluster of this one machine.

Deselected by default, since it takes minutes and system packages: ``pytest -m slurm``. Under
Debian the packages are slurmctld, slurmd, slurm-client and munge.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import pytest

from tests.workflow.workdir import REPOSITORY, Workdir

pytestmark = pytest.mark.slurm

WITH_SLURM = Path(__file__).with_name("with_slurm.sh")
PROFILE = REPOSITORY / "profiles" / "slurm"
QUICK = (
    *("--profile", str(PROFILE), "--slurm-no-account"),
    *("--slurm-init-seconds-before-status-checks", "2", "--seconds-between-status-checks", "2"),
)
"""A cluster of one node that answers at once need not be asked every 40 seconds."""

ONE_COLUMN = {
    "table1": {"databases": ["tiny"], "columns": [{"column": "ShapeDNA", "baseline": "shapedna"}]}
}
LONG_JOB = {"datasets": {"tiny": {"shards": 1, "min_vertices": 2000, "max_vertices": 3000}}}
"""Of some seconds, in which it can be found and killed."""
SECONDS = 480


@pytest.fixture(scope="module")
def with_slurm(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Return how a command line begins that runs on a cluster of its own."""
    missing = [
        name for name in ("slurmctld", "slurmd", "sbatch", "munged") if not shutil.which(name)
    ]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)} (Debian: slurmctld slurmd munge)")
    if importlib.util.find_spec("snakemake_executor_plugin_slurm") is None:
        pytest.skip("not installed: snakemake-executor-plugin-slurm (pip install '.[cluster]')")
    begin = [str(WITH_SLURM), str(tmp_path_factory.mktemp("slurm"))]
    started = subprocess.run([*begin, "sinfo"], capture_output=True, text=True, timeout=90)
    if started.returncode:
        pytest.skip(f"Slurm does not start on this machine: {started.stderr.strip()[-300:]}")
    return begin


def test_a_table_made_by_slurm_equals_one_made_here(with_slurm: list[str], tmp_path: Path) -> None:
    here, there = (Workdir(tmp_path / name) for name in ("here", "there"))
    for workdir in (here, there):
        workdir.path.mkdir()
    target = "results/table1.csv"
    done = here.run(target, config=ONE_COLUMN)
    assert done.returncode == 0, done.stdout
    command = [*with_slurm, *there.command(target, *QUICK, config=ONE_COLUMN)]
    sent = subprocess.run(
        command, cwd=there.path, capture_output=True, text=True, timeout=SECONDS, check=False
    )
    assert sent.returncode == 0, sent.stdout + sent.stderr
    assert "submitted with SLURM jobid" in sent.stdout + sent.stderr
    assert len(here.hashes()) > 8
    assert there.hashes() == here.hashes()


def test_a_job_that_dies_loses_only_what_it_had_not_finished(
    with_slurm: list[str], tmp_path: Path
) -> None:
    workdir = Workdir(tmp_path)
    target = "results/surfaces/tiny/0.npz"
    command = [*with_slurm, *workdir.command(target, *QUICK, config=LONG_JOB)]
    log = tmp_path / "run.log"
    with log.open("w") as stream:
        run = subprocess.Popen(command, cwd=tmp_path, stdout=stream, stderr=subprocess.STDOUT)
    victim, finished = None, []
    deadline = time.monotonic() + SECONDS
    while victim is None and run.poll() is None and time.monotonic() < deadline:
        finished = sorted((tmp_path / "results/surfaces").rglob("*.work/*/*.npz"))
        victim = _process_of(tmp_path, "surfaces.py") if finished else None
        time.sleep(0.02)
    assert victim is not None, "the job was over before it could be killed"
    kept = {path: path.stat().st_mtime_ns for path in finished}
    os.kill(victim, signal.SIGKILL)

    while run.poll() is None and time.monotonic() < deadline:
        for path, written in kept.items():
            with suppress(FileNotFoundError):
                assert path.stat().st_mtime_ns == written, "finished work was done again"
        time.sleep(0.05)
    output = log.read_text()
    assert run.wait(timeout=60) == 0, output
    assert "Trying to restart" in output
    assert (tmp_path / target).exists()


def _process_of(folder: Path, script: str) -> int | None:
    """Return the process that runs a script of the workflow in a folder."""
    for entry in Path("/proc").iterdir():
        try:
            command = (entry / "cmdline").read_bytes().decode(errors="replace")
        except OSError:
            continue
        if str(folder) in command and command.rstrip("\0").endswith(script):
            return int(entry.name)
    return None
