"""The step of continuous integration that runs Slurm says why it does not, and breaks nothing."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.workflow.workdir import REPOSITORY

APT = '#!/bin/sh\necho "E: Unable to fetch some archives" >&2\nexit 100\n'


@pytest.mark.parametrize("apt", [None, APT], ids=["without apt-get", "apt-get fails"])
def test_it_is_skipped_with_its_reason(tmp_path: Path, apt: str | None) -> None:
    for name in ("bash", "sh", "tail", "timeout"):
        (tmp_path / name).symlink_to(shutil.which(name) or name)
    if apt:
        (tmp_path / "apt-get").write_text(apt)
        (tmp_path / "apt-get").chmod(0o755)
    done = subprocess.run(
        ["bash", REPOSITORY / ".ci" / "slurm"],
        env={"PATH": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    reason = "no apt-get to install it" if apt is None else "E: Unable to fetch some archives"
    if os.geteuid():
        reason = "the superuser's permissions"
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("Slurm tests skipped: ")
    assert reason in done.stdout
