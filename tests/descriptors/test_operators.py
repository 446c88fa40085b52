"""Eigenpairs: they solve the problem, match the sphere, and repeat."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
import trimesh
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.descriptors import operators as module
from gipkg.descriptors.operators import Operators, Spectrum
from gipkg.errors import UnsupportedMesh


@pytest.mark.parametrize("eigenpairs", [20, 120])
def test_the_eigenpairs_solve_the_generalised_problem(pebble, eigenpairs: int) -> None:
    operators = Operators(pebble, eigenpairs)
    spectrum = operators.spectrum
    assert spectrum.eigenvalues.shape == (eigenpairs,)
    vectors, mass = spectrum.eigenvectors, spectrum.mass
    residual = operators.laplacian @ vectors - mass[:, None] * vectors * spectrum.eigenvalues
    assert np.abs(residual / mass[:, None]).max() < 1e-8 * spectrum.eigenvalues[-1]
    assert_allclose(vectors.T @ (mass[:, None] * vectors), np.eye(eigenpairs), atol=1e-10)
    assert spectrum.eigenvalues[0] == 0
    assert (np.diff(spectrum.eigenvalues) >= 0).all()
    assert_allclose(vectors[:, 0], 1 / np.sqrt(pebble.area), rtol=1e-9)


def test_none_of_the_smallest_is_missed(pebble) -> None:
    """The sparse solver against LAPACK's generalised one on the full matrices."""
    operators = Operators(pebble, 120)
    assert len(pebble.vertices) > module.DENSE_VERTICES
    expected = scipy.linalg.eigh(
        operators.laplacian.toarray(), np.diag(operators.mass), eigvals_only=True
    )
    assert_allclose(operators.spectrum.eigenvalues[1:], expected[1:120], rtol=1e-10)


def test_the_spheres_eigenvalues_come_in_multiplets() -> None:
    mesh = trimesh.creation.icosphere(4)
    values = Operators(mesh, 36).spectrum.eigenvalues
    degree = np.repeat(np.arange(6), 2 * np.arange(6) + 1)
    assert_allclose(values, degree * (degree + 1), rtol=0.02)


def test_dense_and_sparse_solvers_agree(pebble, monkeypatch) -> None:
    sparse = Operators(pebble, 60).spectrum
    monkeypatch.setattr(module, "DENSE_VERTICES", 10**6)
    dense = Operators(pebble, 60).spectrum
    assert_allclose(sparse.eigenvalues, dense.eigenvalues, rtol=1e-10, atol=1e-10)
    assert_allclose(sparse.eigenvectors, dense.eigenvectors, atol=1e-7)


def test_a_second_run_is_bit_equal(pebble) -> None:
    first, second = (Operators(pebble.copy(), 50).spectrum for _ in range(2))
    assert_array_equal(first.eigenvalues, second.eigenvalues)
    assert_array_equal(first.eigenvectors, second.eigenvectors)


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_the_scale_changes_eigenvalues_by_the_inverse_area_alone(pebble, scale: float) -> None:
    scaled = trimesh.Trimesh(pebble.vertices * scale, pebble.faces, process=False)
    here, there = Operators(pebble, 40).spectrum, Operators(scaled, 40).spectrum
    assert_allclose(there.eigenvalues * scale**2, here.eigenvalues, rtol=1e-9)
    assert_allclose(there.eigenvectors * scale, here.eigenvectors, atol=1e-7)


def test_tiny_meshes_have_one_eigenpair_less_than_vertices() -> None:
    spectrum = Operators(trimesh.creation.icosahedron()).spectrum
    assert spectrum.eigenvectors.shape == (12, 11)
    assert np.isfinite(spectrum.eigenvectors).all()


def test_a_spectrum_from_a_file_is_used_as_it_is(pebble) -> None:
    vertices = len(pebble.vertices)
    known = Spectrum(np.arange(3.0), np.ones((vertices, 3)), np.full(vertices, 2.0))
    operators = Operators(pebble, spectrum=known)
    assert operators.spectrum is known
    assert operators.mass is known.mass


def test_the_spectrum_of_another_mesh_is_refused(pebble, small_pebble) -> None:
    spectrum = Operators(small_pebble, 10).spectrum
    with pytest.raises(UnsupportedMesh, match="162 vertices, this one has 642"):
        Operators(pebble, spectrum=spectrum)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_non_finite_coordinate_is_named(pebble, value: float) -> None:
    mesh = trimesh.Trimesh(pebble.vertices.copy(), pebble.faces, process=False)
    mesh.vertices[7, 1] = value
    with pytest.raises(UnsupportedMesh, match="non-finite"):
        _ = Operators(mesh).spectrum


def test_an_unreferenced_vertex_is_named(pebble) -> None:
    vertices = np.vstack([pebble.vertices, [[0.0, 0.0, 9.0]]])
    mesh = trimesh.Trimesh(vertices, pebble.faces, process=False)
    with pytest.raises(UnsupportedMesh, match="vertex 642 has no area"):
        _ = Operators(mesh).spectrum
