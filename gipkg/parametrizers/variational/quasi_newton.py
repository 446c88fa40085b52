"""Quasi-Newton steps from one factorization: many cheap ones where Gauss-Newton takes one.

Near the least area distortion the valleys of the energy are narrow and bend: 2V - 5 face areas meet
2V - 3 degrees of freedom, and some of their combinations hardly change to first order. A
Gauss-Newton step knows nothing of the bend, costs a factorization, and is soon cut short. Here one
factorization preconditions a run of L-BFGS steps, which learn the bend as they go at the price of
a gradient and a solve each.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.lbfgs import Memory
from gipkg.parametrizers.sphere.tangent import tangent_basis
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent

_SUFFICIENT = 1e-4
"""Share of the decrease that the slope promises which a step must bring (Armijo)."""
_SHORTENINGS, _SHORTER, _OFF_A_FLIP = 8, 0.5, 0.25
_LEAST_DAMPING, _MOST_DAMPING, _MORE, _LESS = 1e-8, 1e6, 3.0, 0.5
_OFTEN, _SELDOM = 1 / 3, 1 / 8
"""Shares of shortened steps in a run from which the next one is damped more, or less."""


def run(
    descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64], steps: int
) -> NDArray[np.float64]:
    """Lower the energy of a map by a run of L-BFGS steps in the tangent planes at its start.

    Parameters
    ----------
    descent : Descent
        Its factorization is used, and its damping, which is set for the next run.
    energy : MapEnergy
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    steps : int
        At most; the run ends where no step leads lower.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, no flipped face.
    """
    chart = _Chart(energy, sphere)
    precondition = descent.preconditioner(energy, sphere, chart.basis)
    memory, shortened = Memory(steps), 0
    value, gradient, point = chart.at(np.zeros(2 * len(sphere)))
    here = np.zeros(2 * len(sphere))
    for _ in range(steps):
        step = -memory.inverse_hessian(gradient, precondition)
        slope = float(gradient @ step)
        length = 1.0
        for _ in range(_SHORTENINGS):
            reached, new_gradient, moved = chart.at(here + length * step)
            if reached <= value + _SUFFICIENT * length * slope:
                break
            length *= _SHORTER if np.isfinite(reached) else _OFF_A_FLIP
        else:
            shortened += steps
            break
        shortened += length < 1
        memory.add(length * step, new_gradient - gradient)
        here, value, gradient, point = here + length * step, reached, new_gradient, moved
    if shortened > _OFTEN * steps:
        descent.damping = min(descent.damping * _MORE, _MOST_DAMPING)
    elif shortened <= _SELDOM * steps:
        descent.damping = max(descent.damping * _LESS, _LEAST_DAMPING)
    descent.iterations += 1
    descent.tell(point, value, 1.0)
    return point


class _Chart:
    """Tangent coordinates (2V,) about a map, and the energy in them."""

    def __init__(self, energy: MapEnergy, sphere: NDArray[np.float64]) -> None:
        self._energy, self._sphere = energy, sphere
        self.basis = tangent_basis(sphere)

    def at(
        self, coordinates: NDArray[np.float64]
    ) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
        """Energy, gradient (2V,) and map (V, 3)."""
        point, lengths = _moved(self._sphere, self.basis, coordinates)
        value, gradient = self._energy.value_and_gradient(point)
        return value, _pulled_back(gradient, point, lengths, self.basis), point


@compiled
def _moved(sphere, basis, coordinates):  # type: ignore[no-untyped-def]
    """Go along tangent coordinates and back to the sphere; how far off it that was."""
    point, lengths = np.empty_like(sphere), np.empty(len(sphere))
    for v in range(len(sphere)):
        square = 0.0
        for c in range(3):
            along = coordinates[2 * v] * basis[v, 0, c] + coordinates[2 * v + 1] * basis[v, 1, c]
            point[v, c] = sphere[v, c] + along
            square += point[v, c] ** 2
        lengths[v] = np.sqrt(square)
        for c in range(3):
            point[v, c] /= lengths[v]
    return point, lengths


@compiled
def _pulled_back(gradient, point, lengths, basis):  # type: ignore[no-untyped-def]
    """Bring a gradient at the moved points to the coordinates along which they moved."""
    pulled = np.zeros(2 * len(point))
    for v in range(len(point)):
        outward = 0.0
        for c in range(3):
            outward += gradient[v, c] * point[v, c]
        for c in range(3):
            tangential = (gradient[v, c] - outward * point[v, c]) / lengths[v]
            pulled[2 * v] += basis[v, 0, c] * tangential
            pulled[2 * v + 1] += basis[v, 1, c] * tangential
    return pulled
