"""Whatever is given as a mesh ends in a closed surface of genus 0 or in an error with a name.

``pytest tests/surfaces/test_bad_meshes.py --hypothesis-profile=long`` tries many more, and so does
``python -m benchmarks.fuzz``.
"""

from __future__ import annotations

import os
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.errors import GipkgError, MeshFormatError, UnsupportedMesh
from gipkg.surfaces import prepare
from tests.support.mutations import damaged
from tests.surfaces.solids import assert_genus_zero, bare, sphere

FEW = settings(max_examples=max(1, settings().max_examples // 5))


def outcome(source: trimesh.Trimesh | Path, **options) -> str:
    """Return how a mesh was closed, or the name of the error."""
    try:
        surface = prepare(source, resolution=12, vertices=40, **options)
    except GipkgError as error:
        return type(error).__name__
    assert_genus_zero(surface.mesh)
    assert surface.mask.shape == (len(surface.mesh.vertices),)
    return surface.report.method


TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]

NUMBERS = st.sampled_from([0.0, 1.0, -1.0, 0.5, 1e-9, 1e9, 3.0])
WILD = st.sampled_from([1e-30, 1e30, 1e-310, 1e308, -1e308, np.nan, np.inf])


@st.composite
def soups(draw) -> trimesh.Trimesh:
    """Few vertices in few places, and faces that share them in every way."""
    numbers = NUMBERS if draw(st.booleans()) else st.one_of(NUMBERS, WILD)
    count = draw(st.integers(1, 9))
    points = draw(st.lists(st.tuples(numbers, numbers, numbers), min_size=count, max_size=count))
    corner = st.integers(0, count - 1)
    faces = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=30))
    return bare(np.array(points), np.array(faces))


@FEW
@given(soups(), st.sampled_from(["auto", "repair", "volume"]), st.booleans())
def test_any_faces_on_any_points(mesh, method, joined):
    outcome(mesh, method=method, components="joined" if joined else "largest", smallest_part=0)


@FEW
@given(st.randoms(use_true_random=False))
def test_any_bytes_in_a_file(tmp_path_factory, random):
    suffix, content = damaged(random)
    path = tmp_path_factory.mktemp("bad", numbered=True) / f"mésh ☃.{suffix}"
    path.write_bytes(content)
    outcome(path)


@pytest.mark.parametrize("scale", [1e-30, 1e-3, 1e30])
def test_size_does_not_matter(scale):
    """Powers of two aside: the same steps, and the same surface up to rounding."""
    opened = bare(sphere(3).vertices, sphere(3).faces[5:])
    scaled = bare(scale * opened.vertices, opened.faces)
    for method in ("repair", "volume"):
        one, two = (prepare(m, method=method, resolution=12) for m in (opened, scaled))
        assert_genus_zero(two.mesh)
        assert [step.name for step in one.report.steps] == [s.name for s in two.report.steps]
        np.testing.assert_allclose(two.mesh.vertices / scale, one.mesh.vertices, atol=1e-6)


@pytest.mark.parametrize(
    ("mesh", "fault"),
    [
        (bare(sphere().vertices * 1e-60, sphere().faces), "Scale it"),
        (bare(sphere().vertices * 1e60, sphere().faces), "Scale it"),
        (bare(sphere().vertices * 1e308 * [1, 1, -1], sphere().faces), "Scale it"),
        (bare(sphere().vertices + 1e13, sphere().faces), "Move it"),
        (bare(np.eye(3), [[0, 1, -1]]), "does not exist"),
        (bare([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 1, 2]]), "no area"),
    ],
    ids=["tiny", "huge", "greatest", "far away", "negative index", "a line"],
)
@pytest.mark.parametrize("method", ["auto", "volume"])
def test_what_cannot_be_computed_with_says_why(mesh, fault, method):
    with pytest.raises(UnsupportedMesh, match=fault):
        prepare(mesh, method=method)


def test_thousands_of_parts():
    rng = np.random.default_rng(0)
    corners = rng.uniform(size=(3000, 1, 3)) + 0.03 * rng.normal(size=(3000, 3, 3))
    dust = bare(corners.reshape(-1, 3), np.arange(9000).reshape(-1, 3))
    assert outcome(dust, components="joined") == "volume"


def test_every_edge_of_many_faces():
    rng = np.random.default_rng(0)
    mesh = bare(rng.normal(size=(12, 3)), rng.integers(0, 12, (3000, 3)))
    assert outcome(mesh) == "volume"


def test_the_same_faces_a_hundred_times():
    mesh = bare(sphere(1).vertices, np.tile(sphere(1).faces, (100, 1)))
    assert outcome(mesh) == "repair"
    assert outcome(bare(mesh.vertices, np.concatenate((mesh.faces, mesh.faces[:, ::-1])))) != "none"


@pytest.mark.parametrize("count", [1, 2])
def test_a_triangle_or_two(count):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]])
    mesh = bare(corners, np.array([[0, 1, 2], [2, 1, 3]])[:count])
    assert outcome(mesh, components="joined") == "volume"


@pytest.mark.parametrize("suffix", ["off", "obj", "ply", "stl", "glb"])
def test_files_that_are_none(tmp_path, suffix):
    path = tmp_path / f"mesh.{suffix}"
    with pytest.raises(MeshFormatError, match="no such file"):
        prepare(path)
    path.touch()
    with pytest.raises(MeshFormatError, match="empty"):
        prepare(path)
    path.unlink()
    path.mkdir()
    with pytest.raises(MeshFormatError, match="folder"):
        prepare(path)


def test_a_closed_surface_that_holds_nothing_is_no_solid():
    """Two faces back to back are a sphere by their edges, and so is a flat tetrahedron."""
    triangle = bare([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2], [2, 1, 0]])
    flat = bare([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 0]], TETRAHEDRON)
    for mesh in (triangle, flat):
        with pytest.raises(UnsupportedMesh, match="encloses no volume"):
            prepare(mesh, method="repair")
        assert outcome(mesh) == "volume"


def test_what_may_not_be_read_is_named(tmp_path, monkeypatch):
    path = tmp_path / "mesh.off"
    path.write_bytes(b"OFF")
    path.chmod(0)
    refusal = PermissionError(13, "Permission denied", str(path))  # the superuser may read it
    monkeypatch.setattr(Path, "read_bytes", Mock(side_effect=refusal))
    with pytest.raises(MeshFormatError, match=r"mesh\.off: cannot be opened: .*Permission denied"):
        prepare(path)


@pytest.mark.parametrize("name", ["no/such.off", "a\0.off", "n" * 300 + ".off"])
def test_names_that_no_file_can_have(tmp_path, name):
    with pytest.raises(MeshFormatError, match=r"no such file|cannot be opened"):
        prepare(tmp_path / name)


def test_what_is_no_file_of_bytes_is_not_read(tmp_path):
    (tmp_path / "endless.off").symlink_to("/dev/zero")
    os.mkfifo(tmp_path / "silent.stl")
    for name in ("endless.off", "silent.stl"):
        with pytest.raises(MeshFormatError, match="no regular file"):
            prepare(tmp_path / name)


def test_faces_of_very_many_corners_are_refused_before_they_take_their_time(tmp_path):
    path = tmp_path / "gears.off"
    face = " ".join(map(str, [1000, *range(1000)]))
    path.write_text("\n".join(["OFF", "1000 5 0", *["0 0 0"] * 1000, *[face] * 5]))
    with pytest.raises(MeshFormatError, match="many corners"):
        prepare(path)
