"""Normals and what is made of them: closed forms on sphere, torus, cylinder and ellipsoid."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from gipkg.descriptors import describe
from gipkg.descriptors.vertex_normals import vertex_normals


def on_sphere() -> tuple[trimesh.Trimesh, np.ndarray]:
    mesh = trimesh.creation.icosphere(4, radius=3.0)
    return mesh, mesh.vertices / 3.0


def on_torus() -> tuple[trimesh.Trimesh, np.ndarray]:
    mesh = trimesh.creation.torus(1.0, 0.4, 64, 64)
    from_axis = np.linalg.norm(mesh.vertices[:, :2], axis=1, keepdims=True)
    middle = mesh.vertices * [1, 1, 0] / from_axis
    return mesh, (mesh.vertices - middle) / 0.4


def on_cylinder() -> tuple[trimesh.Trimesh, np.ndarray]:
    height = np.linspace(-1, 1, 21)
    profile = np.vstack([[[0, -1]], np.stack([0.5 + 0 * height, height], axis=1), [[0, 1]]])
    mesh = trimesh.creation.revolve(profile, sections=64)
    normals = mesh.vertices * [2, 2, 0]
    edge = np.abs(mesh.vertices[:, 2]) > 0.99
    normals[edge] = np.nan
    return mesh, normals


def on_ellipsoid() -> tuple[trimesh.Trimesh, np.ndarray]:
    mesh = trimesh.creation.icosphere(5)
    mesh.apply_scale([1.0, 1.5, 2.5])
    normals = mesh.vertices / np.array([1.0, 1.5, 2.5]) ** 2
    return mesh, normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.mark.parametrize("shape", [on_sphere, on_torus, on_cylinder, on_ellipsoid])
def test_they_are_those_of_the_shape(shape) -> None:
    mesh, normals = shape()
    known = np.isfinite(normals).all(axis=1)
    found = describe(mesh, "normals")
    assert_allclose(found[known], normals[known], atol=0.015)
    assert_allclose(np.linalg.norm(found, axis=1), 1)
    angle = describe(mesh, "gravity-angle")[known, 0]
    assert_allclose(angle, np.arccos(np.clip(-normals[known, 2], -1, 1)), atol=0.03)
    away = mesh.vertices - mesh.triangles_center.T @ mesh.area_faces / mesh.area
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    radial = describe(mesh, "radial-normal")[known, 0]
    assert_allclose(radial, (normals * away)[known].sum(axis=1), atol=0.015)


def test_the_angle_to_gravity_is_exact_where_the_surface_lies_flat() -> None:
    box = trimesh.creation.box().subdivide()
    middle = np.linalg.norm(box.vertices[:, :2], axis=1) < 1e-9
    angle = describe(box, "gravity-angle")[middle, 0]
    assert_allclose(angle[box.vertices[middle, 2] > 0], np.pi, rtol=1e-15)
    assert (angle[box.vertices[middle, 2] < 0] == 0).all()


def test_the_inside_of_a_torus_looks_back_at_its_centroid() -> None:
    mesh = trimesh.creation.torus(1.0, 0.4)
    radial = describe(mesh, "radial-normal")[:, 0]
    from_axis = np.linalg.norm(mesh.vertices[:, :2], axis=1)
    assert (radial[from_axis < 0.7] < -0.4).all()
    assert (radial[from_axis > 1.3] > 0.8).all()


def test_faces_that_cancel_out_leave_a_unit_vector() -> None:
    folded = np.array([[0, 1, 2], [0, 2, 1]])
    normals = vertex_normals(np.eye(3), folded)
    assert_allclose(normals, np.tile([0, 0, 1.0], (3, 1)))
