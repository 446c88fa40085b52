from dataclasses import replace

import numpy as np
import pytest

from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import ellipsoid, icosphere


def _energy(mesh, shape: float) -> MapEnergy:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    areas, cotangents = face_areas(vertices, faces), corner_cotangents(vertices, faces)
    targets = areas * 4 * np.pi / areas.sum()
    weights = np.sqrt(targets * targets.mean())
    return MapEnergy(faces, targets, weights, cotangents, shape, np.zeros(len(targets)))


def _perturbed(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    sphere = icosphere(1).vertices + 0.05 * rng.normal(size=(42, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    first = np.cross(sphere, rng.normal(size=3))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return sphere, np.stack((first, np.cross(sphere, first)), axis=1)


@pytest.mark.parametrize("shape", [0.0, 0.3])
def test_gradient_agrees_with_finite_differences(shape: float) -> None:
    energy = _energy(ellipsoid(1, 1, 2, subdivisions=1), shape)
    sphere, basis = _perturbed(0)
    gradient, _, _ = energy.derivatives(sphere, basis)

    def value_at(step: np.ndarray) -> float:
        moved = sphere + np.einsum("vd,vdc->vc", step.reshape(-1, 2), basis)
        return energy.value(moved / np.linalg.norm(moved, axis=1, keepdims=True))

    steps = 1e-6 * np.eye(84)
    numeric = [(value_at(step) - value_at(-step)) / 2e-6 for step in steps]
    np.testing.assert_allclose(gradient, numeric, atol=1e-7)


@pytest.mark.parametrize("shape", [0.0, 0.3])
@pytest.mark.parametrize("seed", range(3))
def test_gradient_in_space_has_the_one_in_tangent_coordinates(shape: float, seed: int) -> None:
    energy = replace(
        _energy(ellipsoid(1, 2, 5, subdivisions=1), shape), shifts=np.linspace(-1, 1, 80)
    )
    sphere, basis = _perturbed(seed)
    _, gradient = energy.value_and_gradient(sphere)
    in_tangents = np.einsum("vdc,vc->vd", basis, gradient).ravel()
    expected = energy.derivatives(sphere, basis)[0]
    np.testing.assert_allclose(in_tangents, expected, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("seed", range(5))
def test_every_block_is_positive_semidefinite(seed: int) -> None:
    energy = _energy(ellipsoid(1, 2, 5, subdivisions=1), 0.5)
    sphere, basis = _perturbed(seed)
    _, *blocks = energy.derivatives(sphere, basis)
    for spectrum in map(np.linalg.eigvalsh, blocks):
        assert (spectrum[:, 0] > -1e-12 * spectrum[:, -1]).all()


def test_conformal_term_is_least_for_similar_triangles_and_infinite_at_a_flip() -> None:
    mesh = icosphere(4)
    energy = _energy(mesh, 1.0)
    sphere = np.asarray(mesh.vertices)
    excess = energy.value(sphere) / (4 * np.pi)
    assert 0 <= excess < 2e-3  # the flat triangles lie slightly inside the sphere
    flipped = sphere.copy()
    flipped[0] = -flipped[0]
    assert energy.value(flipped) == np.inf


def test_the_double_cover_is_refused_although_nothing_is_flipped() -> None:
    count = 24
    angle = 4 * np.pi * np.arange(count) / count
    ring = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    sphere = np.vstack((ring, [[0, 0, 1.0], [0, 0, -1.0]]))
    k = np.arange(count)
    after = (k + 1) % count
    faces = np.vstack(
        (
            np.column_stack((k, after, np.full(count, count))),
            np.column_stack((after, k, np.full(count, count + 1))),
        )
    )
    targets = np.full(len(faces), 4 * np.pi / len(faces))
    energy = MapEnergy(faces, targets, targets, np.zeros((len(faces), 3)), 0.0, 0 * targets)
    assert np.linalg.det(sphere[faces]).min() > 0
    assert energy.value(sphere) == np.inf
