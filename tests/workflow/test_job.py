"""What every script of the workflow begins with."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from tests.workflow.workdir import REPOSITORY


@pytest.mark.parametrize("prefix", ["", ".snakemake/storage/s3/bucket", "/scratch/1"])
def test_a_job_is_called_by_its_output_wherever_that_is(
    monkeypatch: pytest.MonkeyPatch, prefix: str
) -> None:
    monkeypatch.syspath_prepend(REPOSITORY / "workflow" / "scripts")
    job = importlib.import_module("job")
    out = Path(prefix) / "results" / "surfaces" / "tiny" / "0.npz"
    assert job.label_of(out) == "surfaces/tiny/0"
