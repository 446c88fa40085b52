"""One network for all tests; a folder of meshes for each."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.search.trained import write_meshes, write_network


@pytest.fixture(scope="session")
def network_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("network") / "trained.model.npz"
    write_network(path)
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_meshes(tmp_path / "shapes")
    return tmp_path / "shapes"
