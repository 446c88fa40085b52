"""Energies of maps to the sphere that bound those of spherical triangles from above.

A map sends every face to a flat triangle with its corners on the sphere. Flat triangles
underestimate: all vertices in one point would cost nothing. Projected to the sphere from its
centre, a triangle at distance d from there grows by 1/d at most, hence its Dirichlet energy by
1/d² and its squared area by 1/d⁴. With these factors an energy is never less than that of the
map to the sphere itself, approaches it on fine meshes, and is infinite where a triangle passes
through the centre (Friedel, Schröder & Desbrun, Unconstrained Spherical Parameterization, journal
of graphics tools 2007).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled


@dataclass(frozen=True, slots=True)
class ProjectedEnergy:
    """Mean of the Dirichlet energy and the squared area ratio, in terms of unbounded vectors.

    Both terms are scaled so that an isometry has energy 1 in the limit of fine meshes and every
    other map of degree 1 has more: the Dirichlet energy is at least the area covered, and the
    squares of the area ratios are least, at given total, where all are equal.

    Attributes
    ----------
    faces : (F, 3) int64 array
    cotangents : (F, 3) float64 array
        Of the mesh's angles; altered ones measure angles in an altered metric.
    areas : (F,) float64 array
        Of the mesh's faces, summing to 4π.
    area_weight : float
        Share of the area term, in [0, 1].
    """

    faces: NDArray[np.int64]
    cotangents: NDArray[np.float64]
    areas: NDArray[np.float64]
    area_weight: float

    def __call__(self, vectors: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        """Energy and gradient (V, 3) at vectors (V, 3), whose lengths do not matter."""
        length = np.linalg.norm(vectors, axis=1, keepdims=True)
        sphere = vectors / length
        value, gradient = _value_and_gradient(
            sphere, self.faces, self.cotangents, self.areas, self.area_weight
        )
        radial = np.einsum("vc,vc->v", gradient, sphere)[:, None]
        return float(value), (gradient - radial * sphere) / length

    def clearance(self, vectors: NDArray[np.float64]) -> float:
        """Least distance of a triangle from the centre, in [0, 1].

        While no vertex moves farther on the sphere than this, no triangle passes the centre and
        the degree of the map stays what it is.
        """
        sphere = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
        return float(_clearance(sphere, self.faces))


@compiled
def _clearance(sphere, faces):  # type: ignore[no-untyped-def]
    least = 1.0
    for face in faces:
        p, q, r = sphere[face[0]], sphere[face[1]], sphere[face[2]]
        a, b, c = _nearest(((r - q) ** 2).sum(), ((p - r) ** 2).sum(), ((q - p) ** 2).sum())
        least = min(least, ((a * p + b * q + c * r) ** 2).sum())
    return np.sqrt(least)


@compiled
def _nearest(pp, qq, rr):  # type: ignore[no-untyped-def]
    """Barycentric coordinates of the point nearest to the centre, from squared sides.

    It is the circumcentre, since the corners are equally far, or else the middle of the longest
    side.
    """
    a, b, c = pp * (qq + rr - pp), qq * (rr + pp - qq), rr * (pp + qq - rr)
    if a <= 0:
        return 0.0, 0.5, 0.5
    if b <= 0:
        return 0.5, 0.0, 0.5
    if c <= 0:
        return 0.5, 0.5, 0.0
    total = a + b + c
    return a / total, b / total, c / total


@compiled
def _value_and_gradient(  # type: ignore[no-untyped-def]
    sphere, faces, cotangents, areas, area_weight
):
    gradient = np.zeros_like(sphere)
    side, pull, turned = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 3))
    normal, nearest = np.zeros(3), np.zeros(3)
    value = 0.0
    for f in range(len(faces)):
        for k in range(3):
            for c in range(3):
                side[k, c] = sphere[faces[f, (k + 2) % 3], c] - sphere[faces[f, (k + 1) % 3], c]
        squares = (side[0] ** 2).sum(), (side[1] ** 2).sum(), (side[2] ** 2).sum()
        dirichlet = 0.0
        for k in range(3):
            dirichlet += 0.25 * cotangents[f, k] * squares[k]
        _cross(side[0], side[1], normal)  # of twice the triangle's area
        barycentric = _nearest(squares[0], squares[1], squares[2])
        nearest[:] = 0.0
        for k in range(3):
            for c in range(3):
                nearest[c] += barycentric[k] * sphere[faces[f, k], c]
        distance = (nearest**2).sum()  # squared
        if not distance > 0:
            return np.inf, gradient
        conformal = (1 - area_weight) * dirichlet / distance
        area = area_weight * 0.25 * (normal**2).sum() / (areas[f] * distance**2)
        value += conformal + area
        for k in range(3):
            _cross(normal, side[k], turned[k])
            for c in range(3):
                i, j = (k + 1) % 3, (k + 2) % 3
                pull[k, c] = cotangents[f, i] * side[i, c] - cotangents[f, j] * side[j, c]
        # By Danskin's theorem the nearest point counts as fixed in its triangle.
        inwards = -2 * (conformal + 2 * area) / distance
        by_pull = 0.5 * (1 - area_weight) / distance
        by_turn = 0.5 * area_weight / (areas[f] * distance**2)
        for k in range(3):
            for c in range(3):
                gradient[faces[f, k], c] += (
                    by_pull * pull[k, c]
                    + by_turn * turned[k, c]
                    + inwards * barycentric[k] * nearest[c]
                )
    return value / (4 * np.pi), gradient / (4 * np.pi)


@compiled
def _cross(a, b, out):  # type: ignore[no-untyped-def]
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]
