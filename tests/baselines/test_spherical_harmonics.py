from __future__ import annotations

import igl
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose
from scipy.special import roots_legendre, sph_harm_y

from gipkg.baselines.spherical_harmonics import (
    MEAN_DISTANCE,
    RADIUS,
    VARIANCE,
    SphericalHarmonics,
    principal_values,
)
from gipkg.descriptors.operators import Operators
from gipkg.testing import meshes

RADII = RADIUS * (np.arange(8) + 0.5) / 8
PLAIN = SphericalHarmonics(quadratic=False, radii=8)
VALUES = SphericalHarmonics(radii=8)


def represent(mesh: trimesh.Trimesh, baseline: SphericalHarmonics = PLAIN) -> np.ndarray:
    return baseline.represent(mesh, Operators(mesh)).reshape(baseline.radii, -1)


def test_a_sphere_has_degree_0_alone_and_its_energies_are_the_closed_form() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4, radius=37)
    ball.apply_translation((1e4, 0, -1e4))
    found = represent(ball)
    expected = RADII * np.exp(-((RADII - MEAN_DISTANCE) ** 2) / (2 * VARIANCE))
    assert_allclose(found[:, 0], expected / np.linalg.norm(expected), atol=1e-3)
    assert found[:, 1:].max() < 3e-4


def test_bands_are_those_of_another_quadrature_with_other_harmonics() -> None:
    """On a finer grid, so that this is a test of aliasing as well."""
    mesh = meshes.limbed()
    faces = np.asarray(mesh.faces, dtype=np.int64)
    weights = mesh.area_faces / mesh.area
    vertices = mesh.vertices - weights @ mesh.triangles_center
    finer = vertices, faces
    for _ in range(3):
        finer = trimesh.remesh.subdivide(*finer)
    fine = trimesh.Trimesh(*finer, process=False)
    distance = fine.area_faces @ np.linalg.norm(fine.triangles_center, axis=1) / fine.area
    vertices = vertices * MEAN_DISTANCE / distance

    heights, rule = roots_legendre(60)
    theta, phi = np.meshgrid(np.arccos(heights), np.arange(128) * np.pi / 64, indexing="ij")
    directions = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    found = represent(mesh)
    values = []
    for radius in RADII:
        squared = igl.point_mesh_squared_distance(
            radius * directions.reshape(3, -1).T, vertices, faces
        )[0]
        values.append(radius * np.exp(-squared.reshape(theta.shape) / (2 * VARIANCE)))
    area = np.broadcast_to(rule[:, None] * np.pi / 64, theta.shape)
    norm = np.sqrt((area * np.square(values)).sum())
    for degree in (0, 1, 2, 5, 15):
        coefficients = [
            [(area * one * sph_harm_y(degree, m, theta, phi).conj()).sum() for one in values]
            for m in range(-degree, degree + 1)
        ]
        expected = np.linalg.norm(coefficients, axis=0) / norm
        assert_allclose(found[:, degree], expected, atol=2e-4)


def test_a_motion_and_a_size_change_next_to_nothing() -> None:
    mesh = meshes.limbed()
    expected = represent(mesh)
    moved = meshes.moved(meshes.scaled(mesh, 1e3), np.random.default_rng(0))
    found = represent(moved)
    assert np.linalg.norm(found - expected) < 2e-3
    assert np.linalg.norm(represent(meshes.ellipsoid()) - expected) > 0.1
    assert np.linalg.norm(represent(moved, VALUES) - represent(mesh, VALUES)) < 2e-3


def test_the_whole_function_has_norm_1_and_bands_hold_nearly_all_of_it() -> None:
    everything = represent(
        meshes.ellipsoid(), SphericalHarmonics(quadratic=False, radii=8, bands=32)
    )
    assert np.linalg.norm(everything) == pytest.approx(1, abs=1e-4)
    assert 0.98 < np.linalg.norm(represent(meshes.ellipsoid())) < 1


def test_three_values_hold_the_energy_of_degrees_0_and_2() -> None:
    mesh = meshes.limbed()
    with_values, plain = represent(mesh, VALUES), represent(mesh)
    assert with_values.shape == (8, 17)  # And 32 times 17 are 544.
    assert plain.shape == (8, 16)
    assert_allclose(
        np.linalg.norm(with_values[:, :3], axis=1), np.hypot(plain[:, 0], plain[:, 2]), atol=1e-9
    )
    assert_allclose(with_values[:, 3:], np.delete(plain, [0, 2], axis=1))


@settings(max_examples=20)
@given(arrays(float, (2, 3), elements=st.floats(-10, 10)), st.integers(0, 2**32 - 1))
def test_principal_values_are_as_far_apart_as_forms_with_the_same_axes(
    values: np.ndarray, seed: int
) -> None:
    values = np.sort(values, axis=1)
    axes = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    matrices = np.einsum("ik,nk,jk->nij", axes, values, axes)
    moments = (2 * matrices + values.sum(axis=1)[:, None, None] * np.eye(3)) / 15
    difference = values[1] - values[0]
    squared = (2 * (difference**2).sum() + difference.sum() ** 2) / 15
    found = principal_values(moments)
    assert np.linalg.norm(found[1] - found[0]) == pytest.approx(np.sqrt(squared), abs=1e-9)


def test_how_a_surface_is_cut_into_triangles_does_not_matter() -> None:
    mesh = meshes.limbed()
    half = np.arange(len(mesh.faces) // 2)
    finer = trimesh.remesh.subdivide(mesh.vertices, mesh.faces, face_index=half)
    found = represent(trimesh.Trimesh(*finer, process=False))
    assert np.linalg.norm(found - represent(mesh)) < 1e-3
