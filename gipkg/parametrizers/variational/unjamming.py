"""Free faces that are jammed: wrong in area at a minimum of the squared errors.

A map of V vertices has 2V - 3 degrees of freedom and 2V - 5 face areas to meet, as many as a frame
has bars that is just rigid. Like such a frame it has soft modes all over: patterns of too large
and too small faces, some hundred faces wide, that no small move changes. The least-squares error
has minima of its own there. The method of multipliers leaves them: the errors are added up, face by
face, and pushed against until the configuration gives way, and from time to time the map is
let go of and descended without the push.

References
----------
Hestenes, Multiplier and gradient methods, J. Optimization Theory and Applications 1969; Powell
1969. Just rigid frames: Lubensky et al., Phonons and elasticity in critically coordinated lattices,
Reports on Progress in Physics 2015.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.area_residual import area_residual
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run

_PUSHES, _STEPS_A_PUSH = 10, 15
"""In a round."""
_RUNS_BACK, _STEPS_BACK = 2, 20
"""Without a push, at the end of a round."""
_SHARE, _SMALLER = 0.5, 0.7
"""Of its error by which a push grows, and what is left of that after a push got stuck."""
_START_DAMPING, _STUCK = 1e-3, 0.3
"""Damping of the first push, and the one from which pushes lead nowhere but to flat faces."""


def unjam(
    descent: Descent,
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    *,
    rounds: int,
    face_tolerance: float,
) -> NDArray[np.float64]:
    """Lower the energy of a map by rounds of pushes; the lowest map met is kept.

    Parameters
    ----------
    descent : Descent
    energy : MapEnergy
        With no shifts.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    rounds : int
        At most; of a dozen factorizations each.
    face_tolerance : float
        Standard deviation of the faces' area ratios that is small enough.

    Returns
    -------
    (V, 3) float64 array
    """
    best, least = sphere, energy.value(sphere)
    pushed, shifts, share = sphere, np.zeros_like(energy.shifts), _SHARE
    descent.damping = _START_DAMPING
    for _ in range(rounds):
        if _ratios(energy, best).std() <= face_tolerance:
            break
        for _ in range(_PUSHES):
            shifts = shifts + share * _residuals(_ratios(energy, pushed))
            pushed = run(descent, replace(energy, shifts=shifts), pushed, _STEPS_A_PUSH)
            if descent.damping > _STUCK:
                pushed, shifts, share = best, np.zeros_like(shifts), share * _SMALLER
                descent.damping = _START_DAMPING
        freed, damping = pushed, descent.damping
        for _ in range(_RUNS_BACK):
            freed = run(descent, energy, freed, _STEPS_BACK)
        descent.damping = damping
        if (value := energy.value(freed)) < least:
            best, least = freed, value
    return best


def _ratios(energy: MapEnergy, sphere: NDArray[np.float64]) -> NDArray[np.float64]:
    return signed_spherical_areas(sphere, energy.faces) / energy.targets


@compiled
def _residuals(ratios):  # type: ignore[no-untyped-def]
    residuals = np.zeros_like(ratios)
    for i in range(len(ratios)):
        residuals[i] = area_residual(ratios[i])[0]
    return residuals
