"""Triangulation of polygon faces, planar or not, convex or not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled

MOST_CORNERS = 1000
"""Of one face. The dynamic programme takes time cubic in the number of corners."""

MOST_WORK = 4 * 10**9
"""Sum of the cubes of all faces' corners: half a minute. No real mesh comes near."""

SHAPE_WEIGHT = 1e-6
"""Weight of the triangles' shape, which chooses between triangulations of equal area and
keeps collinear corners from being joined to a triangle without area."""


@dataclass(frozen=True)
class Polygons:
    """Faces of any number of corners.

    Attributes
    ----------
    corners : (N,) int64 array
        Those of all faces, one after the other, from 0.
    lengths : (F,) int64 array
        How many each face has.
    """

    corners: NDArray[np.int64]
    lengths: NDArray[np.int64]


def triangulate_polygons(vertices: NDArray[np.float64], faces: Polygons) -> NDArray[np.int64]:
    """Triangulate faces of any number of corners without adding vertices.

    The triangulation of least area is chosen (Barequet & Sharir, Filling gaps in the boundary
    of a polyhedron, CAGD 1995); for a planar polygon, concave or not, every triangulation
    that stays inside has that area.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    faces : Polygons
        Fewer than three corners make no triangle.

    Returns
    -------
    (F, 3) int64 array
        Triangles in the order and orientation of the faces.

    Raises
    ------
    ValueError
        A face has more than `MOST_CORNERS` corners, or too many faces have many, or one names a
        vertex that does not exist.
    """
    corners, lengths = faces.corners, faces.lengths
    outside = (corners < 0) | (corners >= len(vertices))
    if outside.any():
        of_face = np.repeat(np.arange(len(lengths)), lengths)
        count = len(np.unique(of_face[outside]))
        raise ValueError(f"{count} faces name a vertex that does not exist")
    if lengths.max(initial=0) > MOST_CORNERS:
        raise ValueError(f"a face has {lengths.max()} corners, more than {MOST_CORNERS}")
    if (lengths**3).sum() > MOST_WORK:
        raise ValueError("too many of its faces have many corners; export it as triangles")
    made = np.maximum(lengths - 2, 0)
    first, first_made = np.cumsum(lengths) - lengths, np.cumsum(made) - made
    triangles = np.empty((made.sum(), 3), np.int64)
    plain = lengths == 3
    triangles[first_made[plain]] = corners[first[plain, None] + np.arange(3)]
    for face in np.flatnonzero(lengths > 3):
        own = corners[first[face] :][: lengths[face]]
        at = first_made[face]
        triangles[at : at + made[face]] = own[least_area_triangles(vertices[own])]
    return triangles


@compiled
def least_area_triangles(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Triangulate a closed loop of (n, 3) points by (n - 2, 3) indices, of least total area."""
    n = len(points)
    cost = np.zeros((n, n))
    apex = np.zeros((n, n), np.int64)
    for gap in range(2, n):
        for i in range(n - gap):
            k = i + gap
            cost[i, k] = np.inf
            apex[i, k] = i + 1  # a corner, even where no cost is less than infinite
            for j in range(i + 1, k):
                total = cost[i, j] + cost[j, k] + _triangle_cost(points[i], points[j], points[k])
                if total < cost[i, k]:
                    cost[i, k] = total
                    apex[i, k] = j
    triangles = np.zeros((n - 2, 3), np.int64)
    pending = [(0, n - 1)]
    filled = 0
    while pending:
        i, k = pending.pop()
        if k - i < 2:
            continue
        j = apex[i, k]
        triangles[filled] = i, j, k
        filled += 1
        pending.append((i, j))
        pending.append((j, k))
    return triangles


@compiled
def _triangle_cost(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> float:
    """Area, and a little for a bad shape: at most a thousandth of the squared edges."""
    doubled = edges = 0.0
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        normal = (b[i] - a[i]) * (c[j] - b[j]) - (b[j] - a[j]) * (c[i] - b[i])
        doubled += normal**2
        edges += (b[k] - a[k]) ** 2 + (c[k] - b[k]) ** 2 + (a[k] - c[k]) ** 2
    area = np.sqrt(doubled) / 2
    shape = edges**2 / (area + 1e-3 * edges + np.finfo(np.float64).tiny)
    return float(area + SHAPE_WEIGHT * shape)
