"""A tutorial, run as it is written: its files are written, its commands executed in order."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

_BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.M | re.S)


@dataclass(frozen=True)
class Block:
    """A block of code: a file if it has a title, else commands."""

    language: str
    title: str
    text: str


def blocks(page: Path) -> list[Block]:
    """Return the blocks of a page of documentation, in order."""
    found = _BLOCK.findall(page.read_text(encoding="utf-8"))
    return [Block(*groups) for groups in found]


def follow(page: Path, folder: Path) -> None:
    """Do what a tutorial says, in a folder that looks like a checkout."""
    # What a tutorial installs is found by its own commands, and by no other test.
    installed = folder / "installed"
    environment = {
        **os.environ,
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "PIP_TARGET": str(installed),
        "PYTHONPATH": str(installed),
    }
    for block in blocks(page):
        if block.title:
            (folder / block.title).write_text(block.text, encoding="utf-8")
            continue
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block.text],
            cwd=folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"{page.name}:\n{block.text}\n{done.stdout}"
