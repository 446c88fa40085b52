"""Snakemake's scheduler on this machine."""

from __future__ import annotations

import subprocess
from pathlib import Path

from tests.workflow.workdir import Workdir

COUNTED = """
from snakemake.cli import main
from snakemake.scheduling.job_scheduler import JobScheduler

again = JobScheduler._schedule_reevalutation

def told(self, delay):
    print("looks for work again later", flush=True)
    again(self, delay)

JobScheduler._schedule_reevalutation = told
main()
"""


def test_a_finished_job_does_not_wake_the_scheduler_up_for_ever(tmp_path: Path) -> None:
    python, _, _, *arguments = Workdir(tmp_path).command("results/datasets/tiny/shapes.csv")
    done = subprocess.run(
        [python, "-c", COUNTED, *arguments],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert "1 of 1 steps (100%) done" in done.stdout, done.stdout
    assert "looks for work again" not in done.stdout
