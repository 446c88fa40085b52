"""Triangulation of polygon faces, planar or not, convex or not."""

from __future__ import annotations

from collections.abc import Sequence

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


def triangulate_polygons(
    vertices: NDArray[np.float64], polygons: Sequence[NDArray[np.int64]]
) -> NDArray[np.int64]:
    """Triangulate faces of any number of corners without adding vertices.

    The triangulation of least area is chosen (Barequet & Sharir, Filling gaps in the boundary
    of a polyhedron, CAGD 1995); for a planar polygon, concave or not, every triangulation
    that stays inside has that area.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    polygons : sequence of int arrays
        The corners of each face, in order; fewer than three make no triangle.

    Returns
    -------
    (F, 3) int64 array
        Triangles in the order and orientation of the faces.

    Raises
    ------
    ValueError
        A face has more than `MOST_CORNERS` corners, or too many faces have many.
    """
    if sum(len(corners) ** 3 for corners in polygons) > MOST_WORK:
        raise ValueError("too many of its faces have many corners; export it as triangles")
    triangles = [np.zeros((0, 3), dtype=np.int64)]
    for corners in polygons:
        if len(corners) > MOST_CORNERS:
            raise ValueError(f"a face has {len(corners)} corners, more than {MOST_CORNERS}")
        if len(corners) == 3:
            triangles.append(corners[None])
        elif len(corners) > 3:
            triangles.append(corners[least_area_triangles(vertices[corners])])
    return np.concatenate(triangles)


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
