import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.parametrizers.unconstrained.energy import ProjectedEnergy
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import ellipsoid, icosphere


def _energy(mesh: trimesh.Trimesh, area_weight: float) -> ProjectedEnergy:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    areas = face_areas(vertices, faces)
    areas *= 4 * np.pi / areas.sum()
    return ProjectedEnergy(faces, corner_cotangents(vertices, faces), areas, area_weight)


def _perturbed(seed: int, noise: float = 0.1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return icosphere(1).vertices * rng.uniform(1, 3, (42, 1)) + noise * rng.normal(size=(42, 3))


@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 2**31), area_weight=st.sampled_from([0.0, 0.4, 1.0]))
def test_gradient_agrees_with_finite_differences(seed: int, area_weight: float) -> None:
    energy = _energy(ellipsoid(1, 1, 2, subdivisions=1), area_weight)
    vectors = _perturbed(seed)
    gradient = energy(vectors)[1]
    for direction in np.random.default_rng(seed).normal(size=(3, 42, 3)):
        ahead, behind = (energy(vectors + h * direction)[0] for h in (1e-6, -1e-6))
        assert (ahead - behind) / 2e-6 == pytest.approx(np.vdot(gradient, direction), abs=1e-7)


def test_lengths_do_not_matter() -> None:
    energy = _energy(ellipsoid(1, 1, 2, subdivisions=1), 0.5)
    vectors = _perturbed(0)
    value, gradient = energy(vectors)
    assert energy(7 * vectors)[0] == pytest.approx(value, rel=1e-14)
    np.testing.assert_allclose(np.einsum("vc,vc->v", gradient, vectors), 0, atol=1e-13)


@pytest.mark.parametrize("area_weight", [0.0, 1.0])
def test_identity_of_the_sphere_has_energy_1_approached_from_above(area_weight: float) -> None:
    excess = [
        _energy(mesh, area_weight)(np.asarray(mesh.vertices))[0] - 1
        for mesh in map(icosphere, range(4))
    ]
    assert min(excess) > 0
    assert np.diff(np.log(excess)).max() < np.log(1 / 3)  # second order in the edge length


@pytest.mark.parametrize("area_weight", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(3))
def test_it_bounds_the_energy_of_the_projected_map(seed: int, area_weight: float) -> None:
    mesh, vectors = ellipsoid(1, 1, 2, subdivisions=1), _perturbed(seed)
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    bound = _energy(mesh, area_weight)(vectors)[0]
    # The projection from the centre, sampled ever more finely.
    points, images, faces = np.asarray(mesh.vertices), vectors, np.asarray(mesh.faces)
    for _ in range(4):
        both, faces = trimesh.remesh.subdivide(np.hstack((points, images)), faces)
        points, images = both[:, :3], both[:, 3:]
    fine = trimesh.Trimesh(points, faces, process=False)
    assert bound > 1.02 * _energy(fine, area_weight)(images)[0] > 1.02


def test_clearance_is_the_distance_to_the_nearest_triangle() -> None:
    for seed in range(5):
        mesh, vectors = icosphere(1), _perturbed(seed, noise=0.5)
        sphere = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
        triangles = sphere[mesh.faces]
        nearest = trimesh.triangles.closest_point(triangles, np.zeros((len(triangles), 3)))
        expected = np.linalg.norm(nearest, axis=1).min()
        measured = _energy(mesh, 0.5).clearance(vectors)
        assert measured == pytest.approx(expected, rel=1e-9)


def test_a_triangle_through_the_centre_costs_without_bound() -> None:
    mesh = trimesh.creation.icosahedron()
    energy = _energy(mesh, 0.5)
    face = mesh.faces[0]
    values = []
    for height in (1e-1, 1e-3, 1e-4):
        vectors = np.array(mesh.vertices)
        turn = 2 * np.pi * np.arange(3) / 3
        vectors[face] = np.column_stack((np.cos(turn), np.sin(turn), np.full(3, height)))
        values.append(energy(vectors)[0])
    # 1/d² of the Dirichlet energy and 1/d⁴ of the squared area.
    assert values[1] > 1e3 * values[0] > 0
    assert values[2] == pytest.approx(1e4 * values[1], rel=0.01)
