"""The end of a way: down to a minimum by runs of quasi-Newton steps.

Gauss-Newton steps see each bend of the valleys of the energy as their end; runs of quasi-Newton
steps follow it. With next to no weight on shape they bring most maps that were pushed within a few
percent of the areas. Where faces block each other they do not, which shows after a few runs.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run

_STEPS_A_RUN = 20
_RUNS, _LEAST_GAIN = 4, 0.05
"""Runs at most toward least energy, and the share of it that each has to gain."""
_RUNS_TO_TOLERANCE, _LEAST_APPROACH, _SHAPE = 15, 0.1, 1e-5
"""Runs at most toward a tolerance, the share of what is above it that each has to take away, and
the weight of shape at most."""
_START_DAMPING = 1e-3


def settle(descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64]) -> NDArray[np.float64]:
    """Descend as long as that gains.

    Parameters
    ----------
    descent : Descent
        Its damping is where the runs begin; it is left as it was.
    energy : MapEnergy
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, no flipped face.
    """
    value, damping = energy.value(sphere), descent.damping
    for _ in range(_RUNS):
        sphere, before = run(descent, energy, sphere, _STEPS_A_RUN), value
        value = energy.value(sphere)
        if value > (1 - _LEAST_GAIN) * before:
            break
    descent.damping = damping
    return sphere


def settle_within(
    descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64], face_tolerance: float
) -> NDArray[np.float64]:
    """Descend until face areas are within a tolerance, as long as that comes nearer.

    Parameters
    ----------
    descent : Descent
        Its damping is left as it was.
    energy : MapEnergy
        Its weight on shape is lowered.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    face_tolerance : float
        Standard deviation of the faces' area ratios that is small enough.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, no flipped face.
    """
    energy = replace(energy, shape=min(_SHAPE, energy.shape))
    std, damping = np.inf, descent.damping
    descent.damping = _START_DAMPING
    for _ in range(_RUNS_TO_TOLERANCE):
        sphere, before = run(descent, energy, sphere, _STEPS_A_RUN), std
        std = face_std(energy, sphere)
        if std <= face_tolerance or before - std < _LEAST_APPROACH * (before - face_tolerance):
            break
    descent.damping = damping
    return sphere


def face_std(energy: MapEnergy, sphere: NDArray[np.float64]) -> float:
    """Measure the standard deviation of the faces' area ratios of a map (V, 3)."""
    return float(face_ratios(energy, sphere).std())


def face_ratios(energy: MapEnergy, sphere: NDArray[np.float64]) -> NDArray[np.float64]:
    """Divide the areas of the faces of a map (V, 3) by those wanted; (F,)."""
    return signed_spherical_areas(sphere, energy.faces) / energy.targets
