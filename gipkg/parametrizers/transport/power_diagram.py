"""Power diagrams of the sphere, read off a convex hull.

Give every site p on the unit sphere a weight w. Its cell are the directions x in which
log(x·p) + w is greatest, that is, in which q = exp(w) p is the extreme point of all: the normal
cone of the convex hull at q (Oliker, Embedding Sⁿ into Rⁿ⁺¹ with given integral Gauss curvature
and optimal mass transport on Sⁿ, Advances in Mathematics 2007). Hence the corners of the cells
are the normals of the hull's faces, the sides are arcs of great circles, and the area of a cell
is the angle defect of the hull at q.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull


@dataclass(frozen=True, slots=True)
class PowerDiagram:
    """The cells of N sites that cover the sphere.

    Attributes
    ----------
    areas : (N,) float64 array
        Steradians; they sum to 4π. Not positive where a site has no cell.
    sides : (S, 2) int64 array
        Pairs of sites whose cells have a side in common.
    slopes : (S,) float64 array
        How fast area passes through a side from the second cell to the first as the first
        weight grows.
    centroids : (N, 3) float64 array
        Unit vectors to the centroids of the cells; zero where a site has no cell.
    """

    areas: NDArray[np.float64]
    sides: NDArray[np.int64]
    slopes: NDArray[np.float64]
    centroids: NDArray[np.float64]


def power_diagram(points: NDArray[np.float64]) -> PowerDiagram:
    """Divide the sphere among weighted sites.

    Parameters
    ----------
    points : (N, 3) float64 array
        The sites p scaled by exp(w); not all in one plane.

    Returns
    -------
    PowerDiagram
    """
    triangles, neighbors = _hull(points)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    face, corner = np.nonzero(np.arange(len(triangles))[:, None] < neighbors)
    sides = np.column_stack([triangles[face, (corner + k) % 3] for k in (1, 2)]).astype(np.int64)
    across = points[sides[:, 0]] - points[sides[:, 1]]
    length = np.linalg.norm(across, axis=1)
    start, end = normals[face], normals[neighbors[face, corner]]
    half_arc = np.arctan2(np.linalg.norm(start - end, axis=1), np.linalg.norm(start + end, axis=1))
    # The integral of x along an arc from a to b of angle 2t is (a + b) tan t, and a point x of
    # the side moves by (x·q) dw / |q - q'|.
    slopes = np.einsum("sc,sc->s", start + end, points[sides[:, 0]]) * np.tan(half_arc) / length
    return PowerDiagram(
        areas=_angle_defects(corners, triangles, len(points)),
        sides=sides,
        slopes=slopes,
        centroids=_centroids(sides, half_arc[:, None] * across / length[:, None], len(points)),
    )


def _hull(points: NDArray[np.float64]) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """Outward triangles (T, 3) of the hull, and the neighbours (T, 3) opposite their corners."""
    hull = ConvexHull(points)
    triangles, neighbors = hull.simplices.copy(), hull.neighbors.copy()
    p, q, r = (points[triangles[:, k]] for k in range(3))
    inward = np.einsum("tc,tc->t", np.cross(q - p, r - p), hull.equations[:, :3]) < 0
    triangles[inward] = triangles[inward, ::-1]
    neighbors[inward] = neighbors[inward, ::-1]
    return triangles, neighbors


def _angle_defects(
    corners: NDArray[np.float64], triangles: NDArray[np.integer], count: int
) -> NDArray[np.float64]:
    defects = np.full(count, 2 * np.pi)
    for k in range(3):
        a, b = (corners[:, (k + j) % 3] - corners[:, k] for j in (1, 2))
        angles = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("tc,tc->t", a, b))
        defects -= np.bincount(triangles[:, k], angles, count)
    defects[np.bincount(triangles.ravel(), minlength=count) == 0] = 0.0
    return defects


def _centroids(
    sides: NDArray[np.int64], pulls: NDArray[np.float64], count: int
) -> NDArray[np.float64]:
    """Integrate x over every cell: half the sum over its sides of angle times inward normal."""
    total = np.zeros((count, 3))
    for c in range(3):
        total[:, c] = np.bincount(sides[:, 0], pulls[:, c], count)
        total[:, c] -= np.bincount(sides[:, 1], pulls[:, c], count)
    norm = np.linalg.norm(total, axis=1, keepdims=True)
    return np.divide(total, norm, out=total, where=norm > 0)
