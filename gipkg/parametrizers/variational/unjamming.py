"""Areas of all faces as near to exact as they get, by pushes from a smooth map on.

A map of V vertices has 2V - 3 degrees of freedom and 2V - 5 face areas to meet, as many as a frame
has bars that is just rigid. Like such a frame it has soft modes all over: patterns of too large
and too small faces, some hundred faces wide, that no small move changes. The squared errors alone
have minima of their own there, jammed between needles, where they stay.

Here exact areas are a constraint, which the method of multipliers approaches: errors are added up,
face by face, and pushed against. It begins at a smooth map, where the shape of the triangles
weighs as much as their areas, and that weight falls a level at a time, so that areas are met while
the triangles are still round. From the last level on every round lets go of the map and descends
without the push.

References
----------
Hestenes, Multiplier and gradient methods, J. Optimization Theory and Applications 1969; Powell
1969. Just rigid frames: Lubensky et al., Phonons and elasticity in critically coordinated lattices,
Reports on Progress in Physics 2015.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.area_residual import area_residual
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run

SMOOTH = 1.0
"""Weight of shape at whose minimum the pushes begin."""
_LEVELS = tuple(np.geomspace(SMOOTH, 1e-4, 10))
"""Weights of shape on the way down."""
_PUSHES_A_LEVEL, _PUSHES_A_ROUND, _STEPS_A_PUSH = 5, 10, 15
_RUNS_BACK, _STEPS_BACK, _LEAST_GAIN = 4, 20, 0.05
"""Without a push, at the end of a round; the share of the energy that a run has to gain."""
_ALL_ROUNDS = 3_500
"""Vertices up to which all rounds are taken; a larger mesh takes fewer, in about the same time."""
_SHARE, _LESS, _LEAST_SHARE = 0.5, 0.8, 0.2
"""Of its error by which a push grows, at first; what is left of that after a round; at least."""
_START_DAMPING, _STUCK, _LEFT = 1e-3, 0.3, 0.5
"""Damping at first, and the one from which pushes flatten faces; what is left of them then."""


def unjam(
    descent: Descent,
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    *,
    rounds: int,
    face_tolerance: float,
) -> NDArray[np.float64]:
    """Bring a smooth map near to exact face areas; the map of least energy met is kept.

    Parameters
    ----------
    descent : Descent
    energy : MapEnergy
        With no shifts.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face; best at the minimum for the weight `SMOOTH` of shape.
    rounds : int
        At most, after the levels on the way down, of a dozen factorizations each; of a mesh of
        more than 3,500 vertices fewer in proportion, so that the time is bounded.
    face_tolerance : float
        Standard deviation of the faces' area ratios that is small enough.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, no flipped face.
    """
    best, least = sphere, energy.value(sphere)
    shifts = np.zeros_like(energy.shifts)
    descent.damping = _START_DAMPING
    for shape in _LEVELS:
        if shape > energy.shape:
            level = replace(energy, shape=shape)
            for _ in range(_PUSHES_A_LEVEL):
                sphere, shifts = _push(descent, level, sphere, shifts, _SHARE)
    share = _SHARE
    for _ in range(ceil(rounds * min(1.0, _ALL_ROUNDS / len(sphere)))):
        for _ in range(_PUSHES_A_ROUND):
            sphere, shifts = _push(descent, energy, sphere, shifts, share)
        share = max(_LESS * share, _LEAST_SHARE)
        damping = descent.damping
        freed = _let_go(descent, energy, sphere)
        descent.damping = damping
        if (value := energy.value(freed)) < least:
            best, least = freed, value
        if _ratios(energy, best).std() <= face_tolerance:
            break
    return best


def _push(
    descent: Descent,
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    shifts: NDArray[np.float64],
    share: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Follow the minimum (V, 3); add a share of the errors that it leaves to the shifts (F,)."""
    sphere = run(descent, replace(energy, shifts=shifts), sphere, _STEPS_A_PUSH)
    shifts = shifts + share * _residuals(_ratios(energy, sphere))
    if descent.damping > _STUCK:
        descent.damping, shifts = _START_DAMPING, _LEFT * shifts
    return sphere, shifts


def _let_go(
    descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Descend from a pushed map (V, 3) without the push, while that gains."""
    value = energy.value(sphere)
    for _ in range(_RUNS_BACK):
        sphere, before = run(descent, energy, sphere, _STEPS_BACK), value
        value = energy.value(sphere)
        if value > (1 - _LEAST_GAIN) * before:
            break
    return sphere


def _ratios(energy: MapEnergy, sphere: NDArray[np.float64]) -> NDArray[np.float64]:
    return signed_spherical_areas(sphere, energy.faces) / energy.targets


@compiled
def _residuals(ratios):  # type: ignore[no-untyped-def]
    residuals = np.zeros_like(ratios)
    for i in range(len(ratios)):
        residuals[i] = area_residual(ratios[i])[0]
    return residuals
