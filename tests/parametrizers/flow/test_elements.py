"""Linear elements and Poisson's equation against closed forms and dense linear algebra."""

import numpy as np
import pytest

from gipkg.descriptors.laplacian import cotangent_laplacian, edge_lengths
from gipkg.parametrizers.flow.linear_elements import LinearElements
from gipkg.parametrizers.flow.poisson import Poisson
from gipkg.surfaces.areas import at_vertices
from tests.support.shapes import ellipsoid, icosphere

MESH = ellipsoid(1, 1.3, 2, subdivisions=2)
VERTICES, FACES = np.asarray(MESH.vertices), np.asarray(MESH.faces, np.int64)


@pytest.fixture(scope="module")
def elements() -> LinearElements:
    return LinearElements(VERTICES, FACES)


def test_hats_are_one_at_their_corner_and_zero_at_the_others(elements) -> None:
    corners = VERTICES[FACES]
    for i in range(3):
        for j in range(3):
            along = np.einsum("fc,fc->f", elements.hats[:, i], corners[:, j] - corners[:, i])
            np.testing.assert_allclose(along, float(i == j) - 1, atol=1e-12)
    normals = np.einsum("fc,fic->fi", MESH.face_normals, elements.hats)
    np.testing.assert_allclose(normals, 0, atol=1e-12)


def test_angles_and_areas_agree_with_trimesh(elements) -> None:
    np.testing.assert_allclose(elements.angles, MESH.face_angles, rtol=1e-9)
    np.testing.assert_allclose(elements.areas, MESH.area_faces, rtol=1e-12)


def test_stiffness_is_the_cotangent_laplacian(elements) -> None:
    other = cotangent_laplacian(MESH, edge_lengths(MESH))
    np.testing.assert_allclose(elements.stiffness().toarray(), other.toarray(), atol=1e-3)


def test_vertex_gradients_are_averages_by_angle(elements) -> None:
    values = np.random.default_rng(0).standard_normal(len(VERTICES))
    of_faces = np.einsum("fi,fic->fc", values[FACES], elements.hats)
    expected = np.zeros_like(VERTICES)
    for v in range(len(VERTICES)):
        face, corner = np.nonzero(v == FACES)
        expected[v] = np.average(of_faces[face], axis=0, weights=elements.angles[face, corner])
    np.testing.assert_allclose(elements.vertex_gradients(values), expected, atol=1e-12)


def test_heights_on_the_unit_sphere_solve_poissons_equation() -> None:
    mesh = icosphere(5)
    elements = LinearElements(np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int64))
    height = mesh.vertices[:, 2]
    # -Δz = 2z on the unit sphere; its gradient is the axis without its normal part.
    areas = at_vertices(elements.areas, elements.faces, elements.count)
    solution = Poisson(elements.stiffness()).solve(2 * height * areas)
    np.testing.assert_allclose(solution, height, atol=2e-3)
    expected = np.array([0, 0, 1]) - height[:, None] * mesh.vertices
    np.testing.assert_allclose(elements.vertex_gradients(height), expected, atol=2e-3)


@pytest.mark.parametrize("rank", [None, 10, len(VERTICES) - 1, 10_000])
def test_solutions_are_those_of_the_pseudo_inverse_of_that_rank(elements, rank) -> None:
    stiffness = elements.stiffness()
    values, vectors = np.linalg.eigh(stiffness.toarray())
    kept = slice(1, None if rank is None else rank + 1)
    right = np.random.default_rng(1).standard_normal(len(VERTICES))
    expected = vectors[:, kept] @ ((vectors[:, kept].T @ right) / values[kept])
    np.testing.assert_allclose(Poisson(stiffness, rank).solve(right), expected, atol=1e-8)


def test_a_mean_makes_no_difference(elements) -> None:
    poisson = Poisson(elements.stiffness())
    right = np.random.default_rng(2).standard_normal(len(VERTICES))
    np.testing.assert_allclose(poisson.solve(right), poisson.solve(right + 5), atol=1e-10)
