import numpy as np
import pytest

from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.parametrizers.unconstrained.energy import ProjectedEnergy
from gipkg.parametrizers.unconstrained.quasi_newton import laplacian_preconditioner, minimize
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import ellipsoid, icosphere


def _problem(mesh):
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    areas = face_areas(vertices, faces)
    areas *= 4 * np.pi / areas.sum()
    return faces, corner_cotangents(vertices, faces).clip(0.02, 50), areas


def test_preconditioner_inverts_stiffness_plus_mass() -> None:
    faces, cotangents, areas = _problem(ellipsoid(1, 2, 3, subdivisions=1))
    solution = laplacian_preconditioner(faces, cotangents, areas)(np.eye(42, 3))
    matrix = np.zeros((42, 42))
    for face, cotangent, area in zip(faces, cotangents, areas, strict=True):
        for k in range(3):
            i, j = face[k - 2], face[k - 1]
            edge = np.eye(42)[i] - np.eye(42)[j]
            matrix += cotangent[k] / 2 * np.outer(edge, edge)
            matrix[face[k], face[k]] += area / 3
    np.testing.assert_allclose(matrix @ solution, np.eye(42, 3), atol=1e-12)


@pytest.mark.parametrize("area_weight", [0.0, 0.5, 1.0])
def test_descent_is_monotonic_and_keeps_the_degree_from_a_bad_start(area_weight: float) -> None:
    mesh = ellipsoid(1, 1, 3, subdivisions=2)
    faces, cotangents, areas = _problem(mesh)
    start = icosphere(2).vertices + np.array((0, 0, 0.8))  # almost all vertices in one hemisphere
    start /= np.linalg.norm(start, axis=1, keepdims=True)
    told = []
    reached = minimize(
        ProjectedEnergy(faces, cotangents, areas, area_weight),
        start,
        laplacian_preconditioner(faces, cotangents, areas),
        max_iterations=60,
        tolerance=0,
        callback=told.append,
    )
    objective = [iteration.objective for iteration in told]
    assert [iteration.number for iteration in told] == list(range(len(told)))
    assert (np.diff(objective) <= 0).all()
    assert objective[-1] < 0.75 * objective[0]
    assert np.array_equal(told[-1].sphere, reached)
    for iteration in told:
        total = signed_spherical_areas(iteration.sphere, faces).sum()
        assert total == pytest.approx(4 * np.pi, abs=1e-9)


def test_nothing_moves_at_a_minimum() -> None:
    mesh = icosphere(0)  # a regular icosahedron
    faces, cotangents, areas = _problem(mesh)
    reached = minimize(
        ProjectedEnergy(faces, cotangents, areas, 0.5),
        np.asarray(mesh.vertices),
        laplacian_preconditioner(faces, cotangents, areas),
        max_iterations=20,
        tolerance=1e-12,
    )
    np.testing.assert_allclose(reached, mesh.vertices, atol=1e-6)
