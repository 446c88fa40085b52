"""The cotangent Laplacian and lumped mass: second routes, closed forms, bad triangles."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from gipkg.descriptors.laplacian import (
    barycentric_mass,
    cotangent_laplacian,
    edge_lengths,
    heron_areas,
)


def laplacian_of(mesh: trimesh.Trimesh) -> sp.csr_array:
    return cotangent_laplacian(mesh, edge_lengths(mesh))


def gradient(mesh: trimesh.Trimesh) -> sp.csr_array:
    """Gradients (3F, V) of the hat functions: the normal crossed with the opposite edge."""
    a, b, c = np.swapaxes(mesh.triangles, 0, 1)
    normal = np.cross(b - a, c - a)
    squared = (normal**2).sum(axis=1, keepdims=True)
    hats = np.stack([np.cross(normal, e) / squared for e in (c - b, a - c, b - a)], axis=2)
    rows = np.repeat(np.arange(3 * len(a)), 3)
    columns = np.repeat(mesh.faces, 3, axis=0).ravel()
    return sp.csr_array((hats.ravel(), (rows, columns)), (3 * len(a), len(mesh.vertices)))


def test_it_is_the_dirichlet_energy_of_linear_functions(pebble) -> None:
    operator = gradient(pebble)
    areas = sp.diags_array(np.repeat(pebble.area_faces, 3))
    second_route = operator.T @ areas @ operator
    assert_allclose(laplacian_of(pebble).toarray(), second_route.toarray(), atol=1e-12)


def test_a_square_has_known_weights() -> None:
    square = trimesh.Trimesh(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], process=False
    )
    expected = np.array([[2, -1, 0, -1], [-1, 2, -1, 0], [0, -1, 2, -1], [-1, 0, -1, 2]]) / 2
    assert_allclose(laplacian_of(square).toarray(), expected, atol=1e-15)
    mass = barycentric_mass(square, edge_lengths(square))
    assert_allclose(mass, [1 / 3, 1 / 6, 1 / 3, 1 / 6], atol=1e-15)


@settings(max_examples=20)
@given(seed=st.integers(0, 10**6), exponent=st.integers(-12, 12))
def test_areas_equal_cross_products_at_every_scale(seed: int, exponent: int) -> None:
    corners = np.random.default_rng(seed).standard_normal((3, 3)) * 10.0**exponent
    mesh = trimesh.Trimesh(corners, [[0, 1, 2]], process=False)
    expected = np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) / 2
    longest = edge_lengths(mesh).max()
    assert_allclose(heron_areas(edge_lengths(mesh)), expected, atol=1e-5 * longest**2, rtol=1e-9)


@pytest.mark.parametrize("defect", ["needle", "cap", "collapsed edge", "collapsed face"])
def test_degenerate_faces_leave_a_finite_semidefinite_operator(pebble, defect: str) -> None:
    mesh = pebble.copy()
    a, b, c = mesh.faces[0]
    if defect == "needle":
        mesh.vertices[a] = mesh.vertices[b] + 1e-13
    elif defect == "cap":
        mesh.vertices[a] = (mesh.vertices[b] + mesh.vertices[c]) / 2
    elif defect == "collapsed edge":
        mesh.vertices[a] = mesh.vertices[b]
    else:
        mesh.vertices[a] = mesh.vertices[b] = mesh.vertices[c]
    lengths = edge_lengths(mesh)
    laplacian = cotangent_laplacian(mesh, lengths)
    dense = laplacian.toarray()
    assert np.isfinite(dense).all()
    assert_allclose(dense, dense.T, atol=0)
    values = np.linalg.eigvalsh(dense)
    assert values[0] > -1e-9 * values[-1]
    assert values[1] > 1e-4
    mass = barycentric_mass(mesh, lengths)
    assert mass.min() > 0
    assert mass.sum() == pytest.approx(mesh.area, rel=1e-3)


def test_constants_are_in_the_kernel_and_masses_sum_to_the_area(pebble) -> None:
    laplacian = laplacian_of(pebble)
    assert_allclose(laplacian @ np.ones(len(pebble.vertices)), 0, atol=1e-12)
    assert barycentric_mass(pebble, edge_lengths(pebble)).sum() == pytest.approx(pebble.area)
