"""Every tutorial does what it says."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.docs.tutorial import blocks, follow
from tests.workflow.workdir import REPOSITORY, Workdir

TUTORIALS = sorted((REPOSITORY / "docs" / "tutorials").glob("*.md"))


@pytest.fixture
def checkout(smoke: Workdir, tmp_path: Path) -> Path:
    """A folder like a checkout, with the results of a smoke run that it goes on from."""
    smoke.copy(tmp_path)
    shutil.copytree(REPOSITORY / "results/reference", tmp_path / "results/reference")
    for name in ("config", "profiles", "workflow"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    for name in ("Snakefile", "environment.yml"):
        shutil.copy(REPOSITORY / name, tmp_path)
    return tmp_path


@pytest.mark.parametrize("tutorial", TUTORIALS, ids=lambda path: path.stem)
def test_a_tutorial_does_what_it_says(tutorial: Path, checkout: Path) -> None:
    follow(tutorial, checkout)


def test_every_tutorial_has_files_and_commands() -> None:
    assert [page.stem for page in TUTORIALS] == [
        "baseline",
        "database",
        "descriptor",
        "parametrizer",
    ]
    for page in TUTORIALS:
        titles = [block.title for block in blocks(page)]
        assert any(titles)
        assert not all(titles)
