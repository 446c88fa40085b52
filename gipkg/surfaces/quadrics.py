"""Quadrics: how far a point is from the surface that a vertex stands for.

A quadric is ten numbers: the upper triangle of a symmetric 3×3 matrix A, a vector b and a
number c, for the error xᵀAx + 2bᵀx + c at a point x (M. Garland, P. S. Heckbert, Surface
Simplification Using Quadric Error Metrics, SIGGRAPH 1997).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled

EVENNESS = 0.02
"""Weight of squared distances from the vertices themselves beside those from their planes.
Among equally flat collapses it prefers short ones, so triangles stay regular."""

_UPPER = ((0, 0, 0, 1, 1, 2), (0, 1, 2, 1, 2, 2))


def vertex_quadrics(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the (V, 10) quadrics of the vertices, weighted by area.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
    areas : (V,) array
        A third of the area of the faces around every vertex.
    """
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    doubled = np.cross(b - a, c - a)
    length = np.linalg.norm(doubled, axis=1)
    normal = np.divide(
        doubled, length[:, None], out=np.zeros_like(doubled), where=length[:, None] > 0
    )
    offset = -np.sum(normal * a, axis=1)
    planes = np.column_stack(
        (normal[:, _UPPER[0]] * normal[:, _UPPER[1]], normal * offset[:, None], offset**2)
    )
    planes *= length[:, None] / 6
    quadrics = np.column_stack(
        [np.bincount(faces.ravel(), np.repeat(planes[:, k], 3), len(vertices)) for k in range(10)]
    )
    points = np.zeros_like(quadrics)
    points[:, [0, 3, 5]] = 1
    points[:, 6:9] = -vertices
    points[:, 9] = np.sum(vertices**2, axis=1)
    return quadrics + EVENNESS * areas[:, None] * points


@compiled
def best_point(one, other, point):  # type: ignore[no-untyped-def]
    """Write the point of least error of two quadrics together; return the error there."""
    a, b, c = one[0] + other[0], one[1] + other[1], one[2] + other[2]
    d, e, f = one[3] + other[3], one[4] + other[4], one[5] + other[5]
    p, q, r = one[6] + other[6], one[7] + other[7], one[8] + other[8]
    # Cofactors of A, which the distances from vertices make positive definite.
    aa, bb, cc = d * f - e * e, c * e - b * f, b * e - c * d
    dd, ee, ff = a * f - c * c, b * c - a * e, a * d - b * b
    determinant = a * aa + b * bb + c * cc
    point[0] = -(aa * p + bb * q + cc * r) / determinant
    point[1] = -(bb * p + dd * q + ee * r) / determinant
    point[2] = -(cc * p + ee * q + ff * r) / determinant
    return one[9] + other[9] + p * point[0] + q * point[1] + r * point[2]
