"""A disc of well-shaped triangles over any closed loop of edges.

The disc is laid out on the unit circle as concentric rings whose spacing grows inwards, so
that a cap of n border edges has O(n) triangles, and no inner edge joins two border vertices:
the cap can never double an edge that the surface already has. In space its vertices take
the harmonic position, that of a soap film in first approximation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

GROWTH = 1.3
"""Ratio of the edge lengths of a ring and the next one outside it."""

LEAST_WEIGHT = 0.05
"""Floor of the cotangent weights: positive weights keep the cap inside the loop's hull."""


@dataclass(frozen=True, slots=True)
class Cap:
    """A triangulated disc over a loop of n points.

    Attributes
    ----------
    vertices : (m, 3) float64 array
        Inner vertices, numbered from n on in `faces`.
    faces : (k, 3) int array
        Triangles that run along the loop in its own direction.
    radius : (m,) float64 array
        Distance of the inner vertices from the middle, 1 being the loop.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    radius: NDArray[np.float64]


def cap(loop: NDArray[np.float64]) -> Cap:
    """Close a loop of (n, 3) points, n >= 3, by a disc of at least one inner vertex."""
    layout, faces = _disc(_arc_angles(loop))
    inner = _harmonic(layout, faces, loop)
    return Cap(inner, faces, np.linalg.norm(layout[len(loop) :], axis=1))


def _arc_angles(loop: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles of the loop's points on the circle, by arc length, evened out a little.

    The even part keeps points apart that coincide in space.
    """
    length = np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1)
    even = np.full(len(loop), 1 / len(loop))
    share = length / length.sum() if length.sum() > 0 else even
    step = 2 * np.pi * (0.8 * share + 0.2 * even)
    angles: NDArray[np.float64] = np.concatenate(([0.0], np.cumsum(step)[:-1]))
    return angles


def _disc(border: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Lay out rings inside the border angles: (n + m, 2) points and the triangles."""
    points = [np.column_stack((np.cos(border), np.sin(border)))]
    faces: list[tuple[int, int, int]] = []
    ring, first, radius, edge = border, 0, 1.0, 2 * np.pi / len(border)
    while True:
        radius -= edge * np.sqrt(3) / 2
        edge *= GROWTH
        count = round(2 * np.pi * radius / edge)
        inner_first = first + len(ring)
        if count < 3:
            points.append(np.zeros((1, 2)))
            size = len(ring)
            faces += [(first + i, first + (i + 1) % size, inner_first) for i in range(size)]
            return np.concatenate(points), np.array(faces, np.int64)
        inner = 2 * np.pi * np.arange(count) / count
        points.append(radius * np.column_stack((np.cos(inner), np.sin(inner))))
        faces += _between_rings(ring, first, inner, inner_first)
        ring, first = inner, inner_first


def _between_rings(
    outer: NDArray[np.float64], outer_first: int, inner: NDArray[np.float64], inner_first: int
) -> list[tuple[int, int, int]]:
    """Triangulate between two rings of ascending angles from 0, stepping on where less is."""
    outer_next = np.append(outer[1:], 2 * np.pi)
    inner_next = np.append(inner[1:], 2 * np.pi)
    faces, i, j = [], 0, 0
    while i < len(outer) or j < len(inner):
        a, b = outer_first + i % len(outer), inner_first + j % len(inner)
        if j == len(inner) or (i < len(outer) and outer_next[i] <= inner_next[j]):
            i += 1
            faces.append((a, outer_first + i % len(outer), b))
        else:
            j += 1
            faces.append((a, inner_first + j % len(inner), b))
    return faces


def _harmonic(
    layout: NDArray[np.float64], faces: NDArray[np.int64], loop: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the (m, 3) inner positions for which every one is the mean of its neighbours."""
    border, size = len(loop), len(layout)
    a = faces.ravel()
    b, c = np.roll(faces, -1, axis=1).ravel(), np.roll(faces, -2, axis=1).ravel()
    p, q = layout[a] - layout[c], layout[b] - layout[c]
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    weight = np.maximum(np.sum(p * q, axis=1) / cross, LEAST_WEIGHT)
    adjacency = coo_array((weight, (a, b)), shape=(size, size))
    adjacency = (adjacency + adjacency.T).tocsr()
    inner = adjacency[border:]
    laplacian = (
        coo_array((inner.sum(axis=1), (np.arange(size - border), np.arange(size - border))))
        - inner[:, border:]
    )
    solution = spsolve(laplacian.tocsc(), inner[:, :border] @ loop)
    return np.asarray(solution).reshape(-1, 3)
