"""Topology told from the faces alone, and remeshing that does not change it."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.datasets.articulated.remesh import decimate, genus, jitter, relax, undulate


@pytest.fixture(scope="module")
def sphere():
    mesh = trimesh.creation.icosphere(4)
    return np.array(mesh.vertices), np.array(mesh.faces)


@pytest.fixture(scope="module")
def torus():
    mesh = trimesh.creation.torus(1.0, 0.4, 48, 32)
    return np.array(mesh.vertices), np.array(mesh.faces)


TETRAHEDRON = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])


def test_genus_of_sphere_and_torus(sphere, torus):
    assert genus(TETRAHEDRON, 4) == 0
    assert genus(sphere[1], len(sphere[0])) == 0
    assert genus(torus[1], len(torus[0])) == 1


@pytest.mark.parametrize(
    ("faces", "count"),
    [
        pytest.param(TETRAHEDRON[:3], 4, id="open"),
        pytest.param(np.vstack([TETRAHEDRON[:3], TETRAHEDRON[3:, ::-1]]), 4, id="flipped face"),
        pytest.param(np.vstack([TETRAHEDRON, TETRAHEDRON + 4]), 8, id="two components"),
        pytest.param(np.vstack([TETRAHEDRON, TETRAHEDRON[:, ::-1]]), 4, id="double sheet"),
        pytest.param(TETRAHEDRON, 5, id="unreferenced vertex"),
        pytest.param(
            np.vstack([TETRAHEDRON, np.array([0, 4, 5, 6])[TETRAHEDRON]]), 7, id="shared vertex"
        ),
    ],
)
def test_genus_is_none_of_what_is_no_surface(faces, count):
    assert genus(faces, count) is None


@given(size=st.integers(100, 1200), adaptive=st.booleans())
@settings(max_examples=10)
def test_decimate_keeps_the_topology_and_meets_the_size(torus, size, adaptive):
    vertices, faces = decimate(*torus, size, adaptive)
    assert len(vertices) == size
    assert genus(faces, size) == 1


def test_undulate_moves_along_normals_with_the_amplitude(sphere):
    moved = undulate(*sphere, 0.01, np.random.default_rng(0))
    shift = moved - sphere[0]
    radial = (shift * sphere[0]).sum(axis=1)
    np.testing.assert_allclose(shift, radial[:, None] * sphere[0], atol=1e-3)
    assert radial.std() == pytest.approx(0.01, rel=0.5)


def test_relax_makes_triangles_regular_and_stays_on_the_surface(sphere):
    rough = sphere[0] + np.random.default_rng(0).normal(scale=0.02, size=sphere[0].shape)
    rough /= np.linalg.norm(rough, axis=1, keepdims=True)
    smooth = relax(rough, sphere[1], rounds=5)

    def edge_spread(vertices):
        edges = np.linalg.norm(vertices[sphere[1]] - vertices[np.roll(sphere[1], 1, 1)], axis=2)
        return edges.std() / edges.mean()

    assert edge_spread(smooth) < 0.6 * edge_spread(rough)
    assert np.abs(np.linalg.norm(smooth, axis=1) - 1).max() < 0.02
    assert relax(rough, sphere[1], rounds=0) is rough


def test_jitter_is_scaled_by_the_edges(sphere):
    vertices, faces = sphere
    for scale in (1.0, 100.0):
        shift = jitter(scale * vertices, faces, 0.1, np.random.default_rng(0)) - scale * vertices
        length = np.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 1]], axis=1).mean()
        assert shift.std() == pytest.approx(0.1 * scale * length, rel=0.1)
