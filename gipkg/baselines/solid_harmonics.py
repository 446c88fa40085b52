"""Solid spherical harmonics, by recurrences in Cartesian coordinates."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray


def solid_harmonics(points: NDArray[np.float64], order: int) -> Iterator[NDArray[np.complex128]]:
    """Yield, for l = 0, …, order, the (l + 1, P) solid harmonics of m = 0, …, l at (P, 3) points.

    Scaled to a mean square of 1 over the unit sphere. Recurrences in Cartesian coordinates,
    regular at the poles and at the origin.
    """
    x, y, z = points.T
    squares = x * x + y * y + z * z
    before = np.zeros((0, len(points)), dtype=complex)
    current = np.ones((1, len(points)), dtype=complex)
    yield current
    for degree in range(1, order + 1):
        d, m = degree, np.arange(degree)[:, None]
        new = np.empty((d + 1, len(points)), dtype=complex)
        new[:d] = np.sqrt((4 * d * d - 1) / (d * d - m * m)) * z * current
        m = m[: d - 1]
        ratio = (2 * d + 1) * ((d - 1) ** 2 - m * m) / ((2 * d - 3) * (d * d - m * m))
        new[: d - 1] -= np.sqrt(ratio) * squares * before
        new[d] = -math.sqrt((2 * d + 1) / (2 * d)) * (x + 1j * y) * current[d - 1]
        yield new
        before, current = current, new
