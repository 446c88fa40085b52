"""Damped Gauss-Newton descent of a map energy that never leaves the bijective maps."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gipkg.api import Callback, Iteration
from gipkg.cholesky import Cholesky, NotPositiveDefinite
from gipkg.compilation import compiled
from gipkg.parametrizers.lbfgs import Preconditioner
from gipkg.parametrizers.sphere.tangent import move, tangent_basis
from gipkg.parametrizers.variational.energy import MapEnergy

_START_DAMPING = 1e-3
_RESTART_DAMPING = 1e-2
_LEAST_DAMPING, _MOST_DAMPING = 1e-12, 1e6
_REJECT, _POOR, _GOOD = 0.05, 0.3, 0.75
"""Shares of the predicted decrease at which a step is taken back, and trusted less or more."""


@dataclass
class Descent:
    """Levenberg-Marquardt descent over one mesh; the sparsity of its systems is analysed once.

    The damping is a multiple of the metric of
    :meth:`~gipkg.parametrizers.variational.energy.MapEnergy.derivatives`: a step that is smooth
    over a small triangle is cheap, one that would turn it over is not. The energy is infinite at
    a flip, so that no step to one is ever taken.

    Attributes
    ----------
    faces : (F, 3) int64 array
    count : int
        Number of vertices V.
    callback : callable, optional
        Told every iteration.
    iterations : int
        Steps taken so far.
    damping : float
        At which the next one begins.
    """

    faces: NDArray[np.int64]
    count: int
    callback: Callback | None = None
    iterations: int = field(default=0, init=False)
    damping: float = field(default=_START_DAMPING, init=False)

    def __post_init__(self) -> None:
        unknowns = (2 * self.faces[:, :, None] + np.arange(2)).reshape(-1, 6)
        first, second = np.tril_indices(6)
        pairs = unknowns[:, first], unknowns[:, second]
        size = 2 * self.count
        keys = np.minimum(*pairs) * size + np.maximum(*pairs)
        keys, slots = np.unique(keys, return_inverse=True)
        self._slots = slots.reshape(-1, 21)
        self._entries = len(keys)
        self._factor = Cholesky(keys % size, keys // size, size)

    def minimize(
        self,
        energy: MapEnergy,
        sphere: NDArray[np.float64],
        *,
        max_iterations: int,
        tolerance: float,
    ) -> NDArray[np.float64]:
        """Descend from a map without flips to one without flips and of less energy.

        Parameters
        ----------
        energy : MapEnergy
        sphere : (V, 3) float64 array
            Unit vectors; no flipped face.
        max_iterations : int
        tolerance : float
            Stop when an iteration lowers the energy by less than this fraction.

        Returns
        -------
        (V, 3) float64 array
            Unit vectors.
        """
        value = energy.value(sphere)
        self.damping = min(self.damping, _RESTART_DAMPING)
        if self.iterations == 0:
            self.tell(sphere, value, 0.0)
        for _ in range(max_iterations):
            basis = tangent_basis(sphere)
            gradient, *blocks = energy.derivatives(sphere, basis)
            hessian, metric = (_gather(block, self._slots, self._entries) for block in blocks)
            moved, reached, ratio = sphere, value, -np.inf
            while ratio < _REJECT:
                coordinates = self._step(hessian + self.damping * metric, gradient)
                if coordinates is not None:
                    moved = move(sphere, basis, coordinates)
                    reached = energy.value(moved)
                    # The model is the damped one: its decrease needs no further product.
                    ratio = (value - reached) / float(-0.5 * coordinates @ gradient)
                if ratio < _REJECT:
                    self.damping *= 4
                    if self.damping > _MOST_DAMPING:
                        return sphere
            gain = (value - reached) / abs(value)
            sphere, value = moved, reached
            self.iterations += 1
            self.tell(sphere, value, 1.0)
            if gain < tolerance:
                break
            if ratio > _GOOD:
                self.damping = max(self.damping / 5, _LEAST_DAMPING)
            elif ratio < _POOR:
                self.damping *= 2
        return sphere

    def preconditioner(
        self, energy: MapEnergy, sphere: NDArray[np.float64], basis: NDArray[np.float64]
    ) -> Preconditioner:
        """Factorize the damped Hessian at a map, with more damping until it can be factorized.

        Parameters
        ----------
        energy : MapEnergy
        sphere : (V, 3) float64 array
            Unit vectors, no flipped face.
        basis : (V, 2, 3) float64 array
            Orthonormal tangent vectors at every vertex.

        Returns
        -------
        callable
            Solves for a gradient (2V,), until the next system is factorized.

        Raises
        ------
        NotPositiveDefinite
            No damping helps.
        """
        _, *blocks = energy.derivatives(sphere, basis)
        hessian, metric = (_gather(block, self._slots, self._entries) for block in blocks)
        while True:
            try:
                self._factor.factorize(hessian + self.damping * metric)
            except NotPositiveDefinite:
                if self.damping > _MOST_DAMPING:
                    raise
                self.damping *= 4
            else:
                return self._factor.solve

    def _step(
        self, values: NDArray[np.float64], gradient: NDArray[np.float64]
    ) -> NDArray[np.float64] | None:
        """Solve for the step; None where the system is not positive definite."""
        try:
            self._factor.factorize(values)
        except NotPositiveDefinite:
            return None
        step = -self._factor.solve(gradient)
        return step if gradient @ step < 0 else None

    def tell(self, sphere: NDArray[np.float64], value: float, step: float) -> None:
        """Tell the callback of the latest iteration."""
        if self.callback:
            self.callback(Iteration(self.iterations, sphere, value, step))


@compiled
def _gather(blocks, slots, entries):  # type: ignore[no-untyped-def]
    """Sum the lower triangles of the blocks (F, 6, 6) into the entries of the matrix."""
    total = np.zeros(entries)
    for f in range(len(blocks)):
        k = 0
        for m in range(6):
            for n in range(m + 1):
                total[slots[f, k]] += blocks[f, m, n]
                k += 1
    return total
