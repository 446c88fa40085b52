"""One smoke run, shared by the tests that look at it or start from it."""

from __future__ import annotations

import pytest

from tests.workflow.workdir import Workdir


@pytest.fixture(scope="session")
def smoke(tmp_path_factory: pytest.TempPathFactory) -> Workdir:
    """Folder of an undisturbed smoke run; not to be changed."""
    workdir = Workdir(tmp_path_factory.mktemp("smoke"))
    done = workdir.run()
    assert done.returncode == 0, done.stdout
    return workdir
