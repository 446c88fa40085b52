"""Limited-memory BFGS: what the last steps of a descent tell of its Hessian.

References
----------
Nocedal & Wright, Numerical Optimization, 2006, Algorithm 7.4.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Preconditioner = Callable[[Vectors], Vectors]

_CURVED = 1e-12
"""Least cosine of a step and its change of the gradient for the pair to be remembered."""


class Memory:
    """The last pairs of a step and the change of the gradient over it, of any shape.

    Parameters
    ----------
    length : int
        Number of pairs that are kept.
    """

    def __init__(self, length: int) -> None:
        self._pairs: deque[tuple[Vectors, Vectors, float]] = deque(maxlen=length)

    @property
    def latest(self) -> tuple[Vectors, Vectors] | None:
        """Step and change of the gradient that were added last."""
        return self._pairs[-1][:2] if self._pairs else None

    def add(self, step: Vectors, change: Vectors) -> None:
        """Remember a pair, unless the energy is not convex along the step."""
        product = float(np.vdot(step, change))
        if product > _CURVED * np.linalg.norm(step) * np.linalg.norm(change):
            self._pairs.append((step, change, product))

    def inverse_hessian(self, gradient: Vectors, precondition: Preconditioner) -> Vectors:
        """Multiply a gradient by the inverse Hessian that the pairs make of a first guess.

        Parameters
        ----------
        gradient : float64 array
        precondition : callable
            Multiplies an array of the gradient's shape by a first guess of the inverse Hessian.

        Returns
        -------
        float64 array
        """
        product = gradient.copy()
        shares = []
        for step, change, curvature in reversed(self._pairs):
            share = np.vdot(step, product) / curvature
            product -= share * change
            shares.append(share)
        product = precondition(product)
        for (step, change, curvature), share in zip(self._pairs, reversed(shares), strict=True):
            product += (share - np.vdot(change, product) / curvature) * step
        return product
