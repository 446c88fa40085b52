from dataclasses import replace

import numpy as np
import pytest

from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.sphere.tangent import move, tangent_basis
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import _Chart, run


def test_every_run_lowers_the_energy_tells_of_it_and_flips_no_face(problem) -> None:
    energy, sphere = problem
    told = []
    descent = Descent(energy.faces, len(sphere), told.append)
    for _ in range(5):
        before = energy.value(sphere)
        sphere = run(descent, energy, sphere, 10)
        assert energy.value(sphere) < before
        assert not flipped_faces(sphere, energy.faces).any()
        np.testing.assert_allclose(np.linalg.norm(sphere, axis=1), 1, atol=1e-15)
        assert told[-1].objective == energy.value(sphere)
    assert [iteration.number for iteration in told] == [1, 2, 3, 4, 5]


def test_it_ends_where_the_gradient_vanishes(problem) -> None:
    energy, start = problem
    smooth = replace(energy, shape=1.0)
    descent, sphere = Descent(energy.faces, len(start)), start
    for _ in range(12):
        sphere = run(descent, smooth, sphere, 20)
    after, before = (
        np.abs(smooth.derivatives(point, tangent_basis(point))[0]).max()
        for point in (sphere, start)
    )
    assert after < 1e-6 * before


def test_it_goes_lower_than_gauss_newton_steps_of_as_many_factorizations(problem) -> None:
    energy, start = problem
    hard = replace(energy, shape=1e-7)
    descent = Descent(energy.faces, len(start))
    sphere = descent.minimize(hard, start, max_iterations=60, tolerance=0)
    newton = descent.minimize(hard, sphere, max_iterations=20, tolerance=0)
    for _ in range(20):
        sphere = run(descent, hard, sphere, 15)
    assert hard.value(sphere) < 0.9 * hard.value(newton)


def test_at_a_minimum_it_stays_and_damping_has_a_bound(problem) -> None:
    energy, start = problem
    smooth = replace(energy, shape=1.0)
    descent, sphere = Descent(energy.faces, len(start)), start
    for _ in range(40):
        sphere = run(descent, smooth, sphere, 20)
    again = run(descent, smooth, sphere, 20)
    assert smooth.value(again) <= smooth.value(sphere)
    assert 1 < descent.damping <= 1e6
    np.testing.assert_allclose(again, sphere, atol=1e-7)


def test_a_chart_gives_the_slopes_of_the_energy_along_its_coordinates(small_problem) -> None:
    energy, sphere = small_problem
    chart = _Chart(energy, sphere)
    rng = np.random.default_rng(0)
    size = 2 * len(sphere)
    here = 1e-4 * rng.standard_normal(size)  # off the middle, where lengths are not 1
    _, gradient, point = chart.at(here)
    np.testing.assert_allclose(point, move(sphere, chart.basis, here), atol=1e-15)
    for _ in range(5):
        along = rng.standard_normal(size)
        ahead, behind = (chart.at(here + sign * 1e-7 * along)[0] for sign in (1, -1))
        assert (ahead - behind) / 2e-7 == pytest.approx(gradient @ along, rel=1e-5)
