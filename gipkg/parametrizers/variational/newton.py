"""Damped Gauss-Newton descent of a map energy that never leaves the bijective maps."""

from __future__ import annotations

import numpy as np
from cholespy import CholeskySolverD, MatrixType
from numpy.typing import NDArray

from gipkg.api import Callback, Iteration
from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.tangent import tangent_basis
from gipkg.parametrizers.variational.energy import MapEnergy

_START_DAMPING = 1e-2
_LEAST_DAMPING, _MOST_DAMPING = 1e-9, 1e4
_SHORTEST_STEP = 1e-3


def minimize(
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    *,
    max_iterations: int,
    tolerance: float,
    callback: Callback | None = None,
) -> NDArray[np.float64]:
    """Descend from a map without flips to one without flips and of less energy.

    The Levenberg-Marquardt damping is the Dirichlet metric of the current triangles: a step
    that is smooth over a small triangle is cheap, one that would turn it over is not. The
    energy is infinite at a flip, so the line search never accepts one.

    Parameters
    ----------
    energy : MapEnergy
    sphere : (V, 3) float64 array
        Unit vectors; no flipped face.
    max_iterations : int
    tolerance : float
        Stop when an iteration lowers the energy by less than this fraction.
    callback : callable, optional

    Returns
    -------
    (V, 3) float64 array
        Unit vectors.
    """
    system = _BlockSystem(energy.faces, len(sphere))
    value = energy.value(sphere)
    damping = _START_DAMPING
    tell = callback or _ignore
    tell(Iteration(0, sphere, value, 0.0))
    for number in range(1, max_iterations + 1):
        basis = tangent_basis(sphere)
        gradient, blocks = energy.derivatives(sphere, basis, damping)
        try:
            coordinates = -system.solve(blocks, gradient).reshape(-1, 2)
        except ValueError:  # not positive definite in double precision: damp it until it is
            length = 0.0
        else:
            step = np.einsum("vd,vdc->vc", coordinates, basis)
            length, moved, reached = _search(energy, sphere, step, value)
        if length == 0:
            damping *= 16
            if damping > _MOST_DAMPING:
                break
            continue
        gain = (value - reached) / abs(value)
        sphere, value = moved, reached
        tell(Iteration(number, sphere, value, length))
        if gain < tolerance:
            break
        if length >= 0.5:
            damping = max(damping / 8, _LEAST_DAMPING)
        elif length < 0.1:
            damping *= 2
    return sphere


def _ignore(_: Iteration) -> None:
    pass


def _search(
    energy: MapEnergy, sphere: NDArray[np.float64], step: NDArray[np.float64], value: float
) -> tuple[float, NDArray[np.float64], float]:
    """Halve the step until the energy falls; length 0 if it does not."""
    length = 1.0
    while length > _SHORTEST_STEP:
        moved = sphere + length * step
        moved /= np.linalg.norm(moved, axis=1, keepdims=True)
        reached = energy.value(moved)
        if reached < value:
            return length, moved, reached
        length /= 2
    return 0.0, sphere, value


class _BlockSystem:
    """Positive definite systems summed from 6 x 6 blocks, one a face; the pattern is kept.

    Parameters
    ----------
    faces : (F, 3) int64 array
    count : int
        Number of vertices V; a system has 2V unknowns.
    """

    def __init__(self, faces: NDArray[np.int64], count: int) -> None:
        unknowns = (2 * faces[:, :, None] + np.arange(2)).reshape(-1, 6)
        rows = np.repeat(unknowns, 6, axis=1).ravel()
        columns = np.tile(unknowns, (1, 6)).ravel()
        self._size = 2 * count
        keys, self._slots = np.unique(columns * self._size + rows, return_inverse=True)
        self._rows = (keys % self._size).astype(np.int32)
        self._columns = (keys // self._size).astype(np.int32)

    def solve(self, blocks: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solve the sum of `blocks` (F, 6, 6) for a right-hand side (2V,)."""
        values = _scatter(blocks.ravel(), self._slots, len(self._rows))
        # Triangles of very different sizes meet in one system; a unit diagonal tames that.
        scale = 1 / np.sqrt(values[self._rows == self._columns])
        values *= scale[self._rows] * scale[self._columns]
        solver = CholeskySolverD(self._size, self._rows, self._columns, values, MatrixType.COO)
        solution = np.zeros_like(right)
        solver.solve(right * scale, solution)
        return solution * scale


@compiled
def _scatter(values, slots, count):  # type: ignore[no-untyped-def]
    total = np.zeros(count)
    for i in range(len(values)):
        total[slots[i]] += values[i]
    return total
