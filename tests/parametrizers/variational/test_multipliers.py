from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from gipkg.parametrizers.variational import multipliers
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run

_PUSHES_A_LEVEL = multipliers.Rounds(0, 0.0, 1.0).pushes_a_level


@pytest.fixture(scope="module")
def smooth(small_problem):
    """Energy of areas alone, and the map at which shape weighs as much as areas."""
    energy, start = small_problem
    descent = Descent(energy.faces, len(start))
    as_shape = replace(energy, shape=multipliers.SMOOTH)
    sphere = descent.minimize(as_shape, start, max_iterations=30, tolerance=1e-2)
    return replace(energy, shape=1e-7), sphere


def _ratios(energy, sphere) -> np.ndarray:
    return signed_spherical_areas(sphere, energy.faces) / energy.targets


def _face_std(energy, sphere) -> float:
    return float(_ratios(energy, sphere).std())


def _rounds(
    energy, sphere, rounds: int, face_tolerance: float = 0.0, trials=1, least_shape=1.0
) -> np.ndarray:
    descent = Descent(energy.faces, len(sphere))
    with threadpool_limits(limits=1):  # for the same bits every time
        return multipliers.toward_exact_face_areas(
            descent,
            energy,
            sphere,
            multipliers.Rounds(rounds, face_tolerance, least_shape, trials=trials),
        )


def test_rounds_lead_nearer_than_a_descent_never_higher_and_flip_no_face(smooth) -> None:
    energy, sphere = smooth
    descent = Descent(energy.faces, len(sphere))
    descended = descent.minimize(energy, sphere, max_iterations=300, tolerance=1e-5)
    maps = [_rounds(energy, sphere, rounds) for rounds in (0, 1, 2, 8)]
    values = [energy.value(one) for one in (sphere, *maps)]
    assert (np.diff(values) <= 0).all()
    assert values[-1] < 0.5 * energy.value(descended)
    assert not any(flipped_faces(one, energy.faces).any() for one in maps)


def test_rounds_end_at_the_tolerance(smooth) -> None:
    energy, sphere = smooth
    wanted = 0.9 * _face_std(energy, _rounds(energy, sphere, 1))
    ended = _rounds(energy, sphere, 12, wanted)
    assert _face_std(energy, ended) <= wanted
    rounds = next(k for k in range(12) if np.array_equal(_rounds(energy, sphere, k), ended))
    assert _face_std(energy, _rounds(energy, sphere, rounds - 1)) > wanted


def test_shape_weighs_less_and_less_and_the_pushes_go_on(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    _rounds(replace(energy, shape=1e-2), sphere, 1)
    levels = [weight for weight in multipliers._LEVELS if weight > 1e-2]
    assert levels == sorted(levels, reverse=True)
    expected = np.repeat(levels, _PUSHES_A_LEVEL)
    back = next(k for k, (one, *_) in enumerate(calls[len(expected) :]) if one.shifts.any())
    assert 1 <= back <= multipliers._RUNS_BACK
    del calls[len(expected) : len(expected) + back]
    pushes = calls[: len(expected) + multipliers._PUSHES_A_ROUND]
    weights = [pushed.shape for pushed, *_ in pushes]
    np.testing.assert_array_equal(weights[: len(expected)], expected)
    assert set(weights[len(expected) :]) == {1e-2}
    growth, momenta = np.zeros(len(energy.faces)), set()
    for (before, _, reached, damping), (after, start, _, _) in pairwise(pushes):
        assert start is reached
        errors = multipliers._residuals(_ratios(energy, reached))
        momentum = 0.5 * (growth @ errors > 0)
        momenta.add(momentum)
        growth = multipliers._SHARE * errors + momentum * growth
        stuck = damping > multipliers._STUCK
        left = multipliers._LEFT if stuck else 1.0
        np.testing.assert_allclose(after.shifts, left * (before.shifts + growth))
        growth = growth * (not stuck)
    assert momenta == {0.0, 0.5}
    assert not any(back.shifts.any() for back, *_ in calls[len(pushes) :])


def test_shape_weighs_a_tenth_after_each_round_down_to_the_least(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    found = _rounds(replace(energy, shape=1e-2), sphere, 4, least_shape=3e-4)
    weights = [one.shape for one, *_ in calls if one.shape <= 1e-2]
    expected = [1e-2, 1e-2, 1e-3, 3e-4, 3e-4]  # back from the levels, then the rounds
    np.testing.assert_allclose(list(dict.fromkeys(weights)), [1e-2, 1e-3, 3e-4])
    pushes = [one.shape for one, *_ in calls if one.shape <= 1e-2 and one.shifts.any()]
    np.testing.assert_allclose(pushes, np.repeat(expected[1:], multipliers._PUSHES_A_ROUND))
    kept = _rounds(replace(energy, shape=1e-2), sphere, 4)
    assert _face_std(energy, found) < 0.8 * _face_std(energy, kept)


def test_no_round_is_taken_where_the_levels_are_enough(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    levels = _rounds(energy, sphere, 0)
    assert _face_std(energy, levels) < 0.5 * _face_std(energy, sphere)
    shares = _noted_shares(monkeypatch)
    enough = _rounds(energy, sphere, 3, 1.01 * _face_std(energy, levels))
    np.testing.assert_array_equal(enough, levels)
    assert len(shares) == len(multipliers._LEVELS) * _PUSHES_A_LEVEL


def test_faces_that_stay_far_off_weigh_more_and_less_again_when_they_are_not() -> None:
    pushed = multipliers._Pushed.at(np.eye(3), 100)
    pushed.shifts, pushed.growth = np.linspace(-1, 1, 100), np.linspace(1, 2, 100)
    force, growing = pushed.shifts.copy(), pushed.growth.copy()
    far, near = np.zeros(100), np.zeros(100)
    far[7], near[8] = -0.5, 1e-3
    weights = []
    for errors in (far, far, near, near, *[far] * 6):
        pushed.weigh(errors)
        weights.append(pushed.weights[7])
        np.testing.assert_allclose(pushed.weights * pushed.shifts, force)
        np.testing.assert_allclose(pushed.weights * pushed.growth, growing)
        assert (np.delete(pushed.weights, [7, 8]) == 1).all()
    np.testing.assert_allclose(weights[:4], [4, 16, 14.4, 12.96])
    assert weights[-1] == 1000
    assert pushed.weights[8] == pytest.approx(16 * 0.9**6)


def test_weights_rule_the_pushes_of_later_rounds_and_not_the_way_back(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    _rounds(energy, sphere, 3)
    expected = multipliers._Pushed.at(sphere, len(energy.faces))
    freed, heaviest, in_rounds = None, set(), False
    for one, _, reached, _ in calls:
        if one.shape == energy.shape and not one.shifts.any():  # on the way back
            np.testing.assert_array_equal(one.weights, energy.weights)
            freed = reached if in_rounds else None
            continue
        if freed is not None:  # a round begins
            expected.weigh(_ratios(energy, freed) - 1)
            freed = None
        np.testing.assert_allclose(one.weights, expected.weights * energy.weights)
        heaviest.add(expected.weights.max())
        in_rounds = one.shape == energy.shape
    assert {1.0, 4.0} <= heaviest


@pytest.mark.parametrize(("limit", "taken"), [(1.0, 10), (0.5, 5), (0.15, 2), (0.01, 1)])
def test_a_large_mesh_takes_fewer_rounds(smooth, monkeypatch, limit, taken) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    monkeypatch.setattr(multipliers, "_ALL_ROUNDS", limit * len(sphere))
    monkeypatch.setattr(multipliers, "_PUSHES_A_ROUND", 4)
    _rounds(energy, sphere, 10)
    pushes = [one for one, *_ in calls if one.shape == energy.shape and one.shifts.any()]
    assert len(pushes) == taken * multipliers._PUSHES_A_ROUND


def test_the_share_of_the_errors_falls_round_by_round_to_the_least(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    shares = _noted_shares(monkeypatch)
    _rounds(energy, sphere, 6)
    down = len(multipliers._LEVELS) * _PUSHES_A_LEVEL
    assert set(shares[:down]) == {multipliers._SHARE}
    expected = [max(0.5 * 0.64**k, 0.2) for k in range(6)]
    np.testing.assert_allclose(shares[down:], np.repeat(expected, multipliers._PUSHES_A_ROUND))


def test_another_way_is_taken_while_far_more_than_the_tolerance_is_left(
    smooth, monkeypatch
) -> None:
    energy, sphere = smooth
    once = _rounds(energy, sphere, 1)
    left = _face_std(energy, once)
    shares = _noted_shares(monkeypatch)
    near = _rounds(energy, sphere, 1, left / 3.9, trials=3)
    np.testing.assert_array_equal(near, once)
    a_way = len(shares)
    shares.clear()
    far = _rounds(energy, sphere, 1, left / 1e3, trials=3)
    assert len(shares) == 3 * a_way
    np.testing.assert_allclose(shares[::a_way], [0.5, 0.32, 0.2048])
    assert energy.value(far) <= energy.value(once)


def test_a_push_that_got_stuck_is_halved(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    monkeypatch.setattr(multipliers, "_SHARE", 1e4)  # flattens faces at once
    monkeypatch.setattr(multipliers, "_MOMENTUM", 0.0)
    freed = _rounds(energy, sphere, 1)
    stuck = next(k for k, (*_, damping) in enumerate(calls) if damping > multipliers._STUCK)
    (before, _, reached, _), (after, start, _, _) = calls[stuck : stuck + 2]
    pushed = before.shifts + 1e4 * multipliers._residuals(_ratios(energy, reached))
    np.testing.assert_allclose(after.shifts, multipliers._LEFT * pushed)
    assert start is reached
    assert energy.value(freed) <= energy.value(sphere)
    assert not flipped_faces(freed, energy.faces).any()


def _noted(monkeypatch) -> list[tuple]:
    """Of every run: its energy, where it starts and ends, and the damping that it leaves."""
    calls = []

    def noting(descent, energy, start, steps):
        point = run(descent, energy, start, steps)
        calls.append((energy, start, point, descent.damping))
        return point

    monkeypatch.setattr(multipliers, "run", noting)
    return calls


def _noted_shares(monkeypatch) -> list[float]:
    """Of every push: by what share of the errors it grows."""
    shares = []
    push = multipliers._Pushed.push

    def noting(pushed, descent, energy, share):
        shares.append(share)
        push(pushed, descent, energy, share)

    monkeypatch.setattr(multipliers._Pushed, "push", noting)
    return shares
