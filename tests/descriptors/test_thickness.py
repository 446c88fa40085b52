"""Balls inside shapes whose medial axis is known."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.testing import assert_allclose

from gipkg.descriptors import describe
from gipkg.descriptors.thickness import LARGEST


def thickness(mesh: trimesh.Trimesh, **parameters: object) -> np.ndarray:
    """In units of the mesh."""
    found = describe(mesh, "thickness", logarithm=False, **parameters)[:, 0]
    return found * np.sqrt(mesh.area)


def test_the_largest_ball_in_a_sphere_is_itself() -> None:
    sphere = trimesh.creation.icosphere(3, radius=3.0)
    assert_allclose(thickness(sphere), 3.0, rtol=0.03)
    assert (describe(sphere, "thickness", logarithm=False) <= LARGEST).all()


def test_a_torus_is_as_thick_as_its_tube_however_it_lies() -> None:
    torus = trimesh.creation.torus(1.0, 0.3, 64, 32)
    assert_allclose(thickness(torus), 0.3, rtol=0.02)
    turn = trimesh.transformations.euler_matrix(0.4, 1.0, 2.0)
    moved = torus.copy().apply_transform(turn).apply_scale(7.0)
    assert_allclose(thickness(moved) / 7, thickness(torus), rtol=1e-6)


def test_the_sides_of_a_slab_are_half_its_height() -> None:
    slab = trimesh.creation.box((4.0, 4.0, 0.5))
    for _ in range(5):
        slab = slab.subdivide()
    inner = np.abs(slab.vertices[:, :2]).max(axis=1) < 1.5
    assert_allclose(thickness(slab)[inner], 0.25, rtol=1e-3)


def test_no_vertex_is_inside_a_ball_when_every_contact_counts() -> None:
    mesh = trimesh.creation.icosphere(3)
    mesh.apply_scale([1.0, 1.5, 4.0])
    radii = thickness(mesh, separation=0.0)
    from gipkg.descriptors.vertex_normals import vertex_normals

    centres = mesh.vertices - radii[:, None] * vertex_normals(mesh.vertices, mesh.faces)
    distances = np.linalg.norm(centres[:, None] - mesh.vertices, axis=2)
    assert (distances.min(axis=1) > radii * (1 - 1e-5)).all()


def test_roughness_hardly_matters() -> None:
    torus = trimesh.creation.torus(1.0, 0.3, 64, 32)
    rough = torus.copy()
    rough.vertices += 0.004 * np.random.default_rng(0).standard_normal(rough.vertices.shape)
    assert np.median(np.abs(thickness(rough) / 0.3 - 1)) < 0.12
    assert np.median(np.abs(thickness(rough, separation=0.0) / 0.3 - 1)) > 0.2
