"""A mesh comes back from each format as exactly as the format can hold it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from gipkg.formats import MESH_SUFFIXES
from gipkg.formats.mesh_reading import read_mesh
from gipkg.formats.mesh_writing import write_mesh

TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


@settings(max_examples=40)
@given(
    arrays.arrays(np.float64, (4, 3), elements=st.floats(-1e30, 1e30, allow_nan=False)),
    st.sampled_from([".ply", ".off", ".obj"]),
)
def test_every_bit_comes_back(
    tmp_path_factory: pytest.TempPathFactory, vertices: np.ndarray, suffix: str
) -> None:
    path = tmp_path_factory.mktemp("meshes") / f"a{suffix}"
    write_mesh(path, trimesh.Trimesh(vertices, TETRAHEDRON, process=False))
    again = read_mesh(path)
    np.testing.assert_array_equal(again.vertices, vertices)
    np.testing.assert_array_equal(again.faces, TETRAHEDRON)


@pytest.mark.parametrize("suffix", [".stl", ".glb", ".STL"])
def test_single_precision(tmp_path: Path, suffix: str) -> None:
    mesh = trimesh.creation.icosphere(subdivisions=1)
    write_mesh(tmp_path / f"a{suffix}", mesh)
    again = read_mesh(tmp_path / f"a{suffix}")
    np.testing.assert_allclose(
        again.vertices[again.faces], mesh.vertices[mesh.faces], rtol=1e-6, atol=1e-7
    )


@pytest.mark.parametrize("suffix", MESH_SUFFIXES)
def test_the_same_mesh_gives_the_same_bytes(tmp_path: Path, suffix: str) -> None:
    mesh = trimesh.creation.box()
    for name in "ab":
        write_mesh(tmp_path / f"{name}{suffix}", mesh)
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_another_suffix_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.ply, \.off, \.obj"):
        write_mesh(tmp_path / "a.txt", trimesh.creation.box())
    assert list(tmp_path.iterdir()) == []
