"""Fixtures shared by all tests."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from filelock import FileLock
from hypothesis import settings

from tests.workflow.workdir import Workdir

settings.register_profile("gipkg", deadline=None, print_blob=True)
settings.register_profile("long", settings.get_profile("gipkg"), max_examples=10_000)
settings.load_profile("gipkg")

REPOSITORY = Path(__file__).resolve().parents[1]


def find_data_root() -> Path | None:
    """Return the folder of the real databases, or None where there is none."""
    if named := os.environ.get("GIPKG_DATA_ROOT"):
        return Path(named).resolve()
    candidates = (REPOSITORY.parent / "shared" / "data", REPOSITORY / "data")
    return next((folder.resolve() for folder in candidates if folder.is_dir()), None)


@pytest.fixture(scope="session")
def data_root() -> Path:
    """Folder of the real databases; a test that asks for it is skipped where it is absent."""
    root = find_data_root()
    if root is None or not root.is_dir():
        pytest.skip("no real databases: set GIPKG_DATA_ROOT, or put them under data/")
    return root


@pytest.fixture(scope="session")
def smoke(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Workdir:
    """Folder of an undisturbed smoke run, one for all workers; not to be changed."""
    base = tmp_path_factory.getbasetemp()
    root = base if worker_id == "master" else base.parent
    workdir, finished = Workdir(root / "smoke-run"), root / "smoke-run.finished"
    with FileLock(root / "smoke-run.lock"):
        if not finished.exists():
            workdir.path.mkdir(exist_ok=True)
            done = workdir.run()
            assert done.returncode == 0, done.stdout
            finished.touch()
    return workdir
