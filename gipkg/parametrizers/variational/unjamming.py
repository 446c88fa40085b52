"""Free faces that are jammed: wrong in area at a minimum of the squared errors.

A map of V vertices has 2V - 3 degrees of freedom and 2V - 5 face areas to meet. A map with all of
them exact is locally unique where it exists, and the least-squares error has minima of its own
where a few faces of very different stretch block each other. The method of multipliers leaves
those: the errors are added up, face by face, and pushed against until the configuration gives
way. What it gives way to is then descended again without the push.

References
----------
Hestenes, Multiplier and gradient methods, J. Optimization Theory and Applications 1969; Powell
1969.
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

_PUSHES = 20
"""In the first round; half as many again after a round that gained little."""
_LITTLE = 0.05
_STEPS_A_PUSH = 4
_STEPS_BACK = 16


def unjam(
    descent: Descent,
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    *,
    rounds: int,
    tolerance: float,
) -> NDArray[np.float64]:
    """Lower the energy of a map by rounds of pushes, each kept if it led lower.

    Parameters
    ----------
    descent : Descent
    energy : MapEnergy
        With no shifts.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    rounds : int
        At most; of about a hundred iterations each.
    tolerance : float
        Relative decrease of the energy that ends the descent after the pushes.

    Returns
    -------
    (V, 3) float64 array
    """
    value, pushes = energy.value(sphere), _PUSHES
    for _ in range(rounds):
        pushed, shifts = sphere, np.zeros_like(energy.shifts)
        for _ in range(pushes):
            ratios = signed_spherical_areas(pushed, energy.faces) / energy.targets
            shifts = shifts + _residuals(ratios)
            pushed = descent.minimize(
                replace(energy, shifts=shifts), pushed, max_iterations=_STEPS_A_PUSH, tolerance=0
            )
        pushed = descent.minimize(energy, pushed, max_iterations=_STEPS_BACK, tolerance=tolerance)
        reached = energy.value(pushed)
        if reached > value * (1 - _LITTLE):
            pushes += pushes // 2
        if reached < value:
            sphere, value = pushed, reached
    return sphere


@compiled
def _residuals(ratios):  # type: ignore[no-untyped-def]
    residuals = np.zeros_like(ratios)
    for i in range(len(ratios)):
        residuals[i] = area_residual(ratios[i])[0]
    return residuals
