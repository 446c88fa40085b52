from dataclasses import replace

import numpy as np
import pytest

from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.unjamming import unjam
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import urchin


@pytest.fixture(scope="module")
def problem() -> tuple[MapEnergy, np.ndarray]:
    mesh = urchin(12, 6.0)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int64)
    areas, cotangents = face_areas(vertices, faces), corner_cotangents(vertices, faces)
    targets = areas * 4 * np.pi / areas.sum()
    weights = np.full(len(faces), targets.mean())
    energy = MapEnergy(faces, targets, weights, cotangents, 1e-2, np.zeros(len(faces)))
    return energy, embed(vertices, faces, targets)


def test_the_energy_falls_every_time_and_no_face_flips(problem) -> None:
    energy, start = problem
    told = []

    def note(iteration) -> None:
        told.append((iteration.number, iteration.objective))
        assert not flipped_faces(iteration.sphere, energy.faces).any()
        assert energy.value(iteration.sphere) == iteration.objective

    descent = Descent(energy.faces, len(start), note)
    descent.minimize(energy, start, max_iterations=30, tolerance=0)
    numbers, values = zip(*told, strict=True)
    assert numbers == tuple(range(len(told)))
    assert len(told) > 10
    assert (np.diff(values) < 0).all()


def test_it_ends_where_the_gradient_vanishes(problem) -> None:
    energy, start = problem
    smooth = replace(energy, shape=1.0)
    descent = Descent(energy.faces, len(start))
    sphere = descent.minimize(smooth, start, max_iterations=300, tolerance=1e-12)
    basis = np.linalg.svd(sphere[:, None, :])[2][:, 1:]
    gradient = smooth.derivatives(sphere, basis)[0]
    before = smooth.derivatives(start, np.linalg.svd(start[:, None, :])[2][:, 1:])[0]
    assert np.abs(gradient).max() < 1e-3 * np.abs(before).max()


def test_rounds_of_pushes_only_ever_lower_the_energy(problem) -> None:
    energy, start = problem
    hard = replace(energy, shape=1e-6)
    descent = Descent(energy.faces, len(start))
    sphere = descent.minimize(hard, start, max_iterations=60, tolerance=1e-4)
    freed = unjam(descent, hard, sphere, rounds=2, tolerance=1e-3)
    assert hard.value(freed) <= hard.value(sphere)
    assert not flipped_faces(freed, energy.faces).any()
    np.testing.assert_array_equal(
        unjam(Descent(energy.faces, len(start)), hard, sphere, rounds=0, tolerance=0), sphere
    )
