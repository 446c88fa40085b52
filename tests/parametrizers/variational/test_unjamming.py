from dataclasses import replace

import numpy as np
import pytest

from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from gipkg.parametrizers.variational import unjamming
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run
from gipkg.parametrizers.variational.unjamming import unjam


@pytest.fixture(scope="module")
def jammed(problem):
    energy, start = problem
    hard = replace(energy, shape=1e-7)
    descent = Descent(energy.faces, len(start))
    return hard, descent.minimize(hard, start, max_iterations=60, tolerance=1e-4)


def _face_std(energy, sphere) -> float:
    return float((signed_spherical_areas(sphere, energy.faces) / energy.targets).std())


def _unjam(energy, sphere, rounds: int, face_tolerance: float = 0.0) -> np.ndarray:
    descent = Descent(energy.faces, len(sphere))
    return unjam(descent, energy, sphere, rounds=rounds, face_tolerance=face_tolerance)


def test_more_rounds_never_lead_higher_and_flip_no_face(jammed) -> None:
    energy, sphere = jammed
    maps = [_unjam(energy, sphere, rounds) for rounds in range(4)]
    np.testing.assert_array_equal(maps[0], sphere)
    values = [energy.value(one) for one in maps]
    assert (np.diff(values) <= 0).all()
    assert values[-1] < 0.5 * values[0]
    assert not any(flipped_faces(one, energy.faces).any() for one in maps)


def test_rounds_end_at_the_tolerance(jammed) -> None:
    energy, sphere = jammed
    wanted = 0.9 * _face_std(energy, sphere)
    ended = _unjam(energy, sphere, 50, wanted)
    assert _face_std(energy, ended) <= wanted
    rounds = next(k for k in range(50) if np.array_equal(_unjam(energy, sphere, k), ended))
    assert _face_std(energy, _unjam(energy, sphere, rounds - 1)) > wanted


def test_after_a_push_that_got_stuck_a_smaller_one_starts_at_the_best_map(
    jammed, monkeypatch
) -> None:
    energy, sphere = jammed
    calls = []

    def noting(descent, pushed_energy, start, steps):
        calls.append([pushed_energy.shifts, start])
        point = run(descent, pushed_energy, start, steps)
        calls[-1].append(descent.damping > unjamming._STUCK)
        return point

    monkeypatch.setattr(unjamming, "run", noting)
    monkeypatch.setattr(unjamming, "_SHARE", 1e4)  # flattens faces at once
    freed = _unjam(energy, sphere, 1)
    pushes = calls[: unjamming._PUSHES]
    first = next(k for k, (_, _, stuck) in enumerate(pushes) if stuck)
    shifts, start, _ = pushes[first + 1]
    assert start is sphere  # nothing better was met in the first round
    np.testing.assert_allclose(shifts, unjamming._SMALLER * pushes[0][0])
    assert energy.value(freed) <= energy.value(sphere)
    assert not flipped_faces(freed, energy.faces).any()
