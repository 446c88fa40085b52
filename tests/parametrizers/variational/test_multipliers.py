from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.variational import multipliers, settling
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run
from gipkg.parametrizers.variational.settling import face_ratios, face_std

_PUSHES_A_LEVEL = multipliers.Rounds(0, 0.0).pushes_a_level


@pytest.fixture(scope="module")
def smooth(small_problem):
    """Energy of areas alone, and the map at which shape weighs as much as areas."""
    energy, start = small_problem
    descent = Descent(energy.faces, len(start))
    as_shape = replace(energy, shape=multipliers.SMOOTH)
    sphere = descent.minimize(as_shape, start, max_iterations=30, tolerance=1e-2)
    return replace(energy, shape=1e-7), sphere


def _rounds(energy, sphere, rounds: int, face_tolerance: float = 0.0, **further) -> np.ndarray:
    descent = Descent(energy.faces, len(sphere))
    with threadpool_limits(limits=1):  # for the same bits every time
        return multipliers.toward_exact_face_areas(
            descent,
            energy,
            sphere,
            multipliers.Rounds(rounds, face_tolerance, **further),
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
    wanted = 0.9 * face_std(energy, _rounds(energy, sphere, 1))
    ended = _rounds(energy, sphere, 12, wanted)
    assert face_std(energy, ended) <= wanted
    rounds = next(k for k in range(12) if np.array_equal(_rounds(energy, sphere, k), ended))
    assert face_std(energy, _rounds(energy, sphere, rounds - 1)) > wanted


def test_shape_weighs_less_and_less_and_the_pushes_go_on(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    _rounds(replace(energy, shape=1e-2), sphere, 1)
    levels = [weight for weight in multipliers._LEVELS if weight > 1e-2]
    assert levels == sorted(levels, reverse=True)
    expected = np.repeat(levels, _PUSHES_A_LEVEL)
    back = next(k for k, (one, *_) in enumerate(calls[len(expected) :]) if one.shifts.any())
    assert 1 <= back <= settling._RUNS
    del calls[len(expected) : len(expected) + back]
    pushes = calls[: len(expected) + multipliers._PUSHES_A_ROUND]
    weights = [pushed.shape for pushed, *_ in pushes]
    np.testing.assert_array_equal(weights[: len(expected)], expected)
    assert set(weights[len(expected) :]) == {1e-2}
    growth, momenta = np.zeros(len(energy.faces)), set()
    for (before, _, reached, damping), (after, start, _, _) in pairwise(pushes):
        assert start is reached
        errors = multipliers._residuals(face_ratios(energy, reached))
        momentum = 0.5 * (growth @ errors > 0)
        momenta.add(momentum)
        growth = multipliers._SHARE * errors + momentum * growth
        stuck = damping > multipliers._STUCK
        left = multipliers._LEFT if stuck else 1.0
        np.testing.assert_allclose(after.shifts, left * (before.shifts + growth))
        growth = growth * (not stuck)
    assert momenta == {0.0, 0.5}
    assert not any(back.shifts.any() for back, *_ in calls[len(pushes) :])


def test_shape_weighs_a_tenth_after_each_round_where_it_may_fall(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    found = _rounds(replace(energy, shape=1e-5), sphere, 4, shape_falls=True)
    pushes = [one.shape for one, *_ in calls if one.shape <= 1e-5 and one.shifts.any()]
    expected = [1e-5, 1e-6, 1e-7, 1e-7]
    np.testing.assert_allclose(pushes, np.repeat(expected, multipliers._PUSHES_A_ROUND))
    kept = _rounds(replace(energy, shape=1e-5), sphere, 4)
    assert face_std(energy, found) < face_std(energy, kept)


def test_where_shape_may_fall_the_way_ends_as_soon_as_areas_are_within_the_tolerance(
    smooth, monkeypatch
) -> None:
    energy, sphere = smooth
    energy = replace(energy, shape=1e-3)
    wanted = 0.8 * face_std(energy, _rounds(energy, sphere, 0, shape_falls=True))
    calls = _noted(monkeypatch)
    found = _rounds(energy, sphere, 12, wanted, shape_falls=True)
    assert face_std(energy, found) <= wanted
    freed = [reached for one, _, reached, _ in calls if not one.shifts.any()][1:]
    assert freed[-1] is calls[-1][2] is found
    assert min(face_std(energy, one) for one in freed[:-1]) > wanted


def test_levels_end_where_there_is_nothing_left_to_push_against(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    calls = _noted(monkeypatch)
    few = {"shape_falls": True, "pushes_a_level": 2}
    energy, wanted = replace(energy, shape=1e-3), 0.4 * face_std(energy, sphere)
    _rounds(energy, sphere, 0, wanted, **few)
    pushes = [(one.shape, reached) for one, _, reached, _ in calls if one.shape > 1e-3]
    left = [face_std(energy, reached) for _, reached in pushes[1::2]]
    assert 1 < len(left) < 7
    assert left[-1] <= wanted < min(left[:-1])
    calls.clear()
    _rounds(energy, sphere, 0, wanted, pushes_a_level=2)
    assert sum(one.shape > 1e-3 for one, *_ in calls) == 2 * 7


def test_pushes_take_as_many_steps_as_they_are_told(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    told = []

    def noting(descent, energy, start, steps):
        told.append(steps)
        return run(descent, energy, start, steps)

    monkeypatch.setattr(multipliers, "run", noting)
    _rounds(energy, sphere, 1, pushes_a_level=1, steps_a_push=4)
    assert told == [4] * (len(multipliers._LEVELS) + multipliers._PUSHES_A_ROUND)


def test_no_round_is_taken_where_the_levels_are_enough(smooth, monkeypatch) -> None:
    energy, sphere = smooth
    levels = _rounds(energy, sphere, 0)
    assert face_std(energy, levels) < 0.5 * face_std(energy, sphere)
    shares = _noted_shares(monkeypatch)
    enough = _rounds(energy, sphere, 3, 1.01 * face_std(energy, levels))
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
            expected.weigh(face_ratios(energy, freed) - 1)
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
    left = face_std(energy, once)
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
    pushed = before.shifts + 1e4 * multipliers._residuals(face_ratios(energy, reached))
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
    monkeypatch.setattr(settling, "run", noting)
    return calls


def _noted_shares(monkeypatch) -> list[float]:
    """Of every push: by what share of the errors it grows."""
    shares = []
    push = multipliers._Pushed.push

    def noting(pushed, descent, energy, share, steps):
        shares.append(share)
        push(pushed, descent, energy, share, steps)

    monkeypatch.setattr(multipliers._Pushed, "push", noting)
    return shares
