from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.variational import settling
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run
from gipkg.parametrizers.variational.settling import face_ratios, face_std, settle, settle_within


@pytest.fixture(scope="module")
def descended(small_problem):
    """Energy, and where a descent by Gauss-Newton steps leaves it."""
    energy, sphere = small_problem
    descent = Descent(energy.faces, len(sphere))
    energy = replace(energy, shape=1e-2)
    return energy, descent.minimize(energy, sphere, max_iterations=100, tolerance=1e-3)


def _noted(monkeypatch) -> list[tuple]:
    """Of every run: its energy and where it ends."""
    calls = []

    def noting(descent, energy, start, steps):
        point = run(descent, energy, start, steps)
        calls.append((energy, point))
        return point

    monkeypatch.setattr(settling, "run", noting)
    return calls


def test_face_std_is_that_of_the_area_ratios(descended) -> None:
    energy, sphere = descended
    corners = sphere[energy.faces]
    # Van Oosterom and Strackee's solid angle, face by face.
    triple = np.linalg.det(corners)
    dots = sum((corners[:, i] * corners[:, i - 1]).sum(1) for i in range(3))
    ratios = 2 * np.arctan2(triple, 1 + dots) / energy.targets
    np.testing.assert_allclose(face_ratios(energy, sphere), ratios)
    assert face_std(energy, sphere) == pytest.approx(ratios.std())


def test_runs_go_on_while_they_gain(descended, monkeypatch) -> None:
    energy, sphere = descended
    calls = _noted(monkeypatch)
    descent = Descent(energy.faces, len(sphere))
    descent.damping = 0.02
    low = replace(energy, shape=1e-4)
    settled = settle(descent, low, sphere)
    values = [low.value(sphere), *(low.value(point) for _, point in calls)]
    gains = [1 - after / before for before, after in pairwise(values)]
    assert (np.array(gains[:-1]) >= 0.05).all()
    assert gains[-1] < 0.05 or len(gains) == 4
    assert settled is calls[-1][1]
    assert descent.damping == 0.02
    assert not flipped_faces(settled, energy.faces).any()


def test_it_ends_with_the_first_run_within_the_tolerance(descended, monkeypatch) -> None:
    energy, sphere = descended
    wanted = 0.6 * face_std(energy, sphere)
    calls = _noted(monkeypatch)
    descent = Descent(energy.faces, len(sphere))
    descent.damping = 0.02
    settled = settle_within(descent, energy, sphere, wanted)
    assert face_std(energy, settled) <= wanted
    assert settled is calls[-1][1]
    assert all(face_std(energy, point) > wanted for _, point in calls[:-1])
    assert {one.shape for one, _ in calls} == {1e-5}
    assert descent.damping == 0.02
    assert not flipped_faces(settled, energy.faces).any()


def test_it_gives_up_where_runs_come_hardly_nearer(descended, monkeypatch) -> None:
    energy, sphere = descended
    calls = _noted(monkeypatch)
    settle_within(Descent(energy.faces, len(sphere)), energy, sphere, 0.0)
    left = [face_std(energy, point) for _, point in calls]
    taken = [1 - after / before for before, after in pairwise(left)]
    assert 1 < len(left) < 15
    assert (np.array(taken[:-1]) >= 0.1).all()
    assert taken[-1] < 0.1


def test_one_run_is_taken_even_within_the_tolerance(descended, monkeypatch) -> None:
    energy, sphere = descended
    calls = _noted(monkeypatch)
    enough = 1.01 * face_std(energy, sphere)
    settled = settle_within(Descent(energy.faces, len(sphere)), energy, sphere, enough)
    assert len(calls) == 1
    assert face_std(energy, settled) < 0.9 * face_std(energy, sphere)
