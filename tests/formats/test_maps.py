"""A spherical map comes back from its file bit by bit, or is named as damaged."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.api import SphericalMap
from gipkg.errors import MeshFormatError
from gipkg.formats import MAP_SUFFIXES
from gipkg.formats.maps import is_map, read_map, write_map


def a_map() -> SphericalMap:
    sphere = trimesh.creation.icosphere(subdivisions=1)
    rng = np.random.default_rng(0)
    mesh = trimesh.Trimesh(rng.normal(size=sphere.vertices.shape), sphere.faces, process=False)
    directions = np.asarray(sphere.vertices)
    return SphericalMap(mesh, directions / np.linalg.norm(directions, axis=1, keepdims=True))


@pytest.mark.parametrize("suffix", MAP_SUFFIXES)
def test_every_bit_comes_back(tmp_path: Path, suffix: str) -> None:
    known, path = a_map(), tmp_path / f"a{suffix}"
    write_map(path, known)
    again = read_map(path)
    assert is_map(path)
    np.testing.assert_array_equal(again.sphere, known.sphere)
    np.testing.assert_array_equal(again.mesh.vertices, known.mesh.vertices)
    np.testing.assert_array_equal(again.mesh.faces, known.mesh.faces)


def test_to_other_programs_a_ply_is_the_sphere(tmp_path: Path) -> None:
    known = a_map()
    write_map(tmp_path / "a.ply", known)
    seen = trimesh.load(tmp_path / "a.ply", process=False)
    np.testing.assert_array_equal(seen.vertices, known.sphere)
    np.testing.assert_array_equal(seen.faces, known.mesh.faces)


def test_any_other_ply_is_no_map(tmp_path: Path) -> None:
    a_map().mesh.export(tmp_path / "mesh.ply")
    assert not is_map(tmp_path / "mesh.ply")
    assert not is_map(tmp_path / "mesh.off")
    assert not is_map(tmp_path / "absent.ply")


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"sphere": 2 * a_map().sphere}, "unit vectors"),
        ({"sphere": a_map().sphere[:-1]}, "places on the sphere"),
        ({"sphere": a_map().sphere * np.nan}, "unit vectors"),
        ({"faces": np.array([[0, 1, 99]])}, "does not exist"),
        ({"faces": np.array([[0, 1, -1]])}, "does not exist"),
        ({"faces": np.array([[0.0, 1.0, 2.0]])}, "not whole numbers"),
        ({"vertices": np.zeros((42, 2))}, "three numbers a row"),
    ],
)
def test_what_is_no_map_is_named(tmp_path: Path, change: dict[str, np.ndarray], fault: str) -> None:
    known = a_map()
    arrays = {"vertices": known.mesh.vertices, "faces": known.mesh.faces, "sphere": known.sphere}
    np.savez(tmp_path / "a.npz", **(arrays | change))
    with pytest.raises(MeshFormatError, match=fault) as caught:
        read_map(tmp_path / "a.npz")
    assert "a.npz" in str(caught.value)
    assert "gipkg parametrize" in str(caught.value)


def test_a_file_without_its_arrays(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", sphere=np.eye(3))
    with pytest.raises(MeshFormatError, match="no array faces, vertices"):
        read_map(tmp_path / "a.npz")
    with pytest.raises(MeshFormatError, match="no such file"):
        read_map(tmp_path / "b.npz")


@settings(max_examples=60)
@given(st.data(), st.sampled_from(MAP_SUFFIXES))
def test_damage_is_named_or_leaves_a_map(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, suffix: str
) -> None:
    path = tmp_path_factory.mktemp("maps") / f"a{suffix}"
    write_map(path, a_map())
    content = bytearray(path.read_bytes())
    content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(len(content) - 50, len(content)))])
    try:
        read = read_map(path)
    except MeshFormatError:
        pass
    else:
        assert np.isfinite(read.mesh.vertices).all()
        assert read.mesh.faces.min() >= 0
        assert read.mesh.faces.max() < len(read.sphere)
