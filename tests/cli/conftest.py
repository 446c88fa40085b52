"""A small mesh in a folder of its own."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from tests.support.shapes import ellipsoid


@pytest.fixture(scope="session")
def egg() -> trimesh.Trimesh:
    return ellipsoid(1.0, 0.8, 1.7, subdivisions=2)


@pytest.fixture
def mesh_file(egg: trimesh.Trimesh, tmp_path: Path) -> Path:
    egg.export(tmp_path / "egg.obj", digits=17)
    return tmp_path / "egg.obj"
