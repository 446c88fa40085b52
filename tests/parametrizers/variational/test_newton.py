from dataclasses import replace

import numpy as np

from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.variational.newton import Descent


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
    sphere = descent.minimize(smooth, start, max_iterations=300, tolerance=1e-9)
    basis = np.linalg.svd(sphere[:, None, :])[2][:, 1:]
    gradient = smooth.derivatives(sphere, basis)[0]
    before = smooth.derivatives(start, np.linalg.svd(start[:, None, :])[2][:, 1:])[0]
    assert np.abs(gradient).max() < 1e-3 * np.abs(before).max()
