"""Sparse Cholesky factorizations of many matrices that share one pattern.

CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008) is used through CVXOPT, which keeps its symbolic
analysis: a factorization then costs about a sixth of one that begins with the analysis.
"""

from __future__ import annotations

import cvxopt
import numpy as np
import scipy.sparse as sp
from cvxopt import cholmod
from numpy.typing import NDArray

from gipkg.errors import ParametrizationError


class NotPositiveDefinite(ParametrizationError, ArithmeticError):
    """The matrix has no Cholesky factorization in double precision.

    Parameters
    ----------
    fault : str
        What was met.
    """

    def __init__(self, fault: str) -> None:
        super().__init__(
            f"{fault}; the mesh or its map has faces without area: remesh it, or choose another "
            "start"
        )


class Cholesky:
    """Factorizations of symmetric positive definite matrices of one pattern.

    Systems are scaled to a unit diagonal first: entries of very different sizes may meet in one.

    Parameters
    ----------
    rows, columns : (K,) integer arrays
        Position of every entry of the lower triangle, diagonal included, each once, sorted by
        column and then by row.
    size : int
        Number of rows n.
    """

    def __init__(self, rows: NDArray[np.integer], columns: NDArray[np.integer], size: int) -> None:
        self._rows, self._columns = rows, columns
        self._diagonal = rows == columns
        self._matrix = cvxopt.spmatrix(
            np.ones(len(rows)), rows.astype(np.int32), columns.astype(np.int32), (size, size)
        )
        self._factor = cholmod.symbolic(self._matrix)
        self._scale = np.ones(size)

    @classmethod
    def of(cls, matrix: sp.sparray) -> Cholesky:
        """Factorize one symmetric positive definite matrix (n, n).

        Raises
        ------
        NotPositiveDefinite
        """
        lower = sp.tril(matrix, format="csc")
        lower.sum_duplicates()
        entries = lower.tocoo()
        factor = cls(entries.row, entries.col, matrix.shape[0])
        factor.factorize(entries.data)
        return factor

    def factorize(self, values: NDArray[np.float64]) -> None:
        """Factorize the matrix with these entries (K,).

        Raises
        ------
        NotPositiveDefinite
        """
        diagonal = values[self._diagonal]
        if not (diagonal > 0).all():
            raise NotPositiveDefinite("a diagonal entry is not positive")
        self._scale = 1 / np.sqrt(diagonal)
        scaled = values * self._scale[self._rows] * self._scale[self._columns]
        self._matrix.V = cvxopt.matrix(scaled)
        try:
            cholmod.numeric(self._matrix, self._factor)
        except ArithmeticError as error:
            raise NotPositiveDefinite("a pivot is not positive") from error

    def solve(self, right: NDArray[np.floating]) -> NDArray[np.float64]:
        """Solve for right-hand sides (n,) or (n, K) with the latest factorization."""
        columns = right.reshape(len(right), -1)
        solution = cvxopt.matrix(columns * self._scale[:, None])
        cholmod.solve(self._factor, solution)
        return (np.asarray(solution) * self._scale[:, None]).reshape(right.shape)
