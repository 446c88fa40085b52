"""Poisson's equation on a closed mesh, factorised once and solved for many right-hand sides."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from gipkg.cholesky import Cholesky

_SHIFT = 1e-8
"""Added to the diagonal, in units of its mean, where the eigenvectors need an inverse."""


class Poisson:
    """Solves L g = b for the positive semidefinite Laplacian L of a closed surface.

    Constants are the kernel of L: of `b` its mean is ignored, and that of `g` is zero.

    Parameters
    ----------
    stiffness : (V, V) sparse array
        Rows sum to zero.
    rank : int, optional
        Take the pseudo-inverse of this rank, of the `rank` smoothest eigenvectors, instead of
        the inverse itself (paper, Section 3). At V - 1 or more they are the same.
    """

    def __init__(self, stiffness: sp.csr_array, rank: int | None = None) -> None:
        count = stiffness.shape[0]
        self._modes: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
        if rank is None or rank >= count - 1:
            # With one value held at zero the rest is positive definite.
            self._solver = Cholesky.of(stiffness[1:, 1:])
        else:
            self._modes = _smoothest_modes(stiffness, rank)

    def solve(self, right: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the solution (V,) of mean zero for a right-hand side (V,)."""
        right = right - right.mean()
        if self._modes is not None:
            values, vectors = self._modes
            return vectors @ ((right @ vectors) / values)
        solution = np.zeros_like(right)
        solution[1:] = self._solver.solve(right[1:])
        return solution - solution.mean()


def _smoothest_modes(
    stiffness: sp.csr_array, rank: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lowest `rank` positive eigenvalues (rank,) and their eigenvectors (V, rank)."""
    count = stiffness.shape[0]
    shift = _SHIFT * stiffness.diagonal().mean()
    solver = Cholesky.of(stiffness + shift * sp.eye_array(count))

    def inverse(right: NDArray[np.float64]) -> NDArray[np.float64]:
        return solver.solve(right.ravel())

    operator = LinearOperator((count, count), matvec=inverse, dtype=np.float64)
    start = np.random.default_rng(0).standard_normal(count)
    values, vectors = eigsh(stiffness, rank + 1, sigma=-shift, OPinv=operator, v0=start)
    return values[1:], vectors[:, 1:]
