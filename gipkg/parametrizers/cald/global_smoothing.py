"""Global smoothing of CALD: the sphere is warped so that areas even out over large regions.

The surface's area, carried to the sphere, has a density there. Its smooth part is made uniform by
the monotone rearrangement (Knothe 1957) first of heights and then of longitudes along every
parallel. Thin faces may flip by that; local smoothing turns most of them back.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import factorial

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.sphere.areas import mean_square_distortion

_ROWS = 50
"""Parallels of the grid of equal areas that carries the density; twice as many meridians."""
_LEAST_SHARE = 0.25


def smooth_globally(
    sphere: NDArray[np.float64],
    faces: NDArray[np.int64],
    areas: NDArray[np.float64],
    degree: int,
    axis: int,
) -> tuple[NDArray[np.float64], float]:
    """Warp the sphere towards equal areas as far as that lowers the area error.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) int64 array
    areas : (F,) float64 array
        Of the faces on the surface, summing to 4π.
    degree : int
        Of the spherical harmonics that make up the smooth part of the density.
    axis : int
        Coordinate that is the height.

    Returns
    -------
    sphere : (V, 3) float64 array
        A new array.
    share : float
        Of the warp; 0 where no part of it helps.
    """
    turned = np.roll(sphere, 2 - axis, axis=1)
    warp = _equalising_warp(turned, faces, areas, degree)
    before = mean_square_distortion(sphere, faces, areas)
    share = 1.0
    while share >= _LEAST_SHARE:
        moved = np.roll(warp.apply(turned, share), axis - 2, axis=1)
        if mean_square_distortion(moved, faces, areas) < before:
            return moved, share
        share /= 2
    return sphere.copy(), 0.0


@dataclass(frozen=True, slots=True)
class _Warp:
    """A homeomorphism of the sphere, monotone in height and along every parallel.

    Attributes
    ----------
    heights : (R + 1,) float64 array
        Images of equally spaced heights, from -1 to 1; linear in between.
    turns : (R, 2R + 1) float64 array
        Displacements of equally spaced longitudes, from 0 to 2π, in the middle of each row;
        bilinear in between.
    """

    heights: NDArray[np.float64]
    turns: NDArray[np.float64]

    def apply(self, sphere: NDArray[np.float64], share: float) -> NDArray[np.float64]:
        """Move (V, 3) unit vectors a share of the way, 1 being all of it."""
        x, y, height = sphere.T
        rows = len(self.turns)
        # Depths below the nearer pole, which keep their relative accuracy close to it.
        depth = (x**2 + y**2) / (1 + np.abs(height))
        grid = np.linspace(0, 2, rows + 1)
        northern = np.interp(depth, grid, 1 - self.heights[::-1])
        southern = np.interp(depth, grid, 1 + self.heights)
        depth += share * (np.where(height > 0, northern, southern) - depth)
        longitude = np.arctan2(y, x) % (2 * np.pi)
        row = np.clip((height + 1) / 2 * rows - 0.5, 0, rows - 1)
        longitude += share * _interpolate(self.turns, row, longitude / np.pi * rows)
        radius = np.sqrt(depth * (2 - depth))
        moved = np.column_stack(
            (
                radius * np.cos(longitude),
                radius * np.sin(longitude),
                np.where(height > 0, 1 - depth, depth - 1),
            )
        )
        return moved / np.linalg.norm(moved, axis=1, keepdims=True)


def _equalising_warp(
    sphere: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64], degree: int
) -> _Warp:
    """Find the warp that makes the smooth part of the carried area uniform."""
    density = _smooth_density(sphere, faces, areas, degree)
    rows = density.sum(axis=1)
    heights = np.r_[0, np.cumsum(rows)]
    shares = np.column_stack((np.zeros(_ROWS), np.cumsum(density, axis=1)))
    turns = 2 * np.pi * (shares / shares[:, -1:] - np.linspace(0, 1, 2 * _ROWS + 1))
    return _Warp(2 * heights / heights[-1] - 1, turns - turns[:, 1:].mean(axis=1, keepdims=True))


def _smooth_density(
    sphere: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64], degree: int
) -> NDArray[np.float64]:
    """Spread the area of every face over the cells (R, 2R) around its centre, up to a factor.

    The kernel ((1 + cos) / 2)^degree is positive and made of harmonics up to that degree.
    """
    x, y, height = sphere[faces].sum(axis=1).T
    height = height / np.sqrt(x**2 + y**2 + height**2)
    row = np.minimum(((height + 1) / 2 * _ROWS).astype(np.int64), _ROWS - 1)
    longitude = np.arctan2(y, x) % (2 * np.pi)
    column = np.minimum((longitude / np.pi * _ROWS).astype(np.int64), 2 * _ROWS - 1)
    cells = np.bincount(row * 2 * _ROWS + column, areas, 2 * _ROWS**2)
    features = _kernel_features(degree)
    return (features @ (cells @ features)).reshape(_ROWS, 2 * _ROWS)


@lru_cache(maxsize=4)
def _kernel_features(degree: int) -> NDArray[np.float64]:
    """Monomials at the cells' centres whose products sum to the kernel: (2R², N).

    They are the terms of the multinomial expansion of (1 + xx' + yy' + zz')^degree.
    """
    height = (2 * np.arange(_ROWS) + 1) / _ROWS - 1
    longitude = (np.arange(2 * _ROWS) + 0.5) / _ROWS * np.pi
    radius = np.sqrt(1 - height**2)
    x, y = np.outer(radius, np.cos(longitude)).ravel(), np.outer(radius, np.sin(longitude)).ravel()
    z = np.repeat(height, 2 * _ROWS)
    columns = []
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            for k in range(degree + 1 - i - j):
                ways = factorial(degree) // factorial(degree - i - j - k)
                ways //= factorial(i) * factorial(j) * factorial(k)
                columns.append(np.sqrt(ways) * x**i * y**j * z**k)
    return np.column_stack(columns)


def _interpolate(
    table: NDArray[np.float64], row: NDArray[np.float64], column: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate a table bilinearly at fractional rows and columns."""
    i = np.minimum(row.astype(np.int64), table.shape[0] - 2)
    j = np.minimum(column.astype(np.int64), table.shape[1] - 2)
    s, t = row - i, column - j
    one = (1 - t) * table[i, j] + t * table[i, j + 1]
    two = (1 - t) * table[i + 1, j] + t * table[i + 1, j + 1]
    between: NDArray[np.float64] = (1 - s) * one + s * two
    return between
