"""Signed areas of spherical triangles and the exact test for flipped faces."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled

_FILTER = 16 * np.finfo(np.float64).eps
"""Forward error bound of the triple product below, relative to its permanent."""


def triple_products(sphere: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.float64]:
    """Compute the determinants det[p, q, r] of the corners of every face.

    They are taken of edge vectors, det[p, q - p, r - p], which keeps the relative accuracy
    of small triangles.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) integer array

    Returns
    -------
    (F,) float64 array
    """
    p, q, r = (sphere[faces[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", p, np.cross(q - p, r - p))


def signed_spherical_areas(
    sphere: NDArray[np.float64], faces: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Signed areas of spherical triangles, positive where counterclockwise from outside.

    The areas of a closed mesh's faces sum to 4π times the degree of the map.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) integer array

    Returns
    -------
    (F,) float64 array
        Steradians, in (-2π, 2π].

    References
    ----------
    Van Oosterom & Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng.
    1983.
    """
    return _signed_areas(sphere, faces)


@compiled
def _signed_areas(sphere, faces):  # type: ignore[no-untyped-def]
    areas = np.empty(len(faces))
    for f in range(len(faces)):
        p, q, r = sphere[faces[f, 0]], sphere[faces[f, 1]], sphere[faces[f, 2]]
        a0, a1, a2 = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        b0, b1, b2 = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        triple = p[0] * (a1 * b2 - a2 * b1) + p[1] * (a2 * b0 - a0 * b2)
        triple += p[2] * (a0 * b1 - a1 * b0)
        cosines = p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
        cosines += q[0] * r[0] + q[1] * r[1] + q[2] * r[2]
        cosines += r[0] * p[0] + r[1] * p[1] + r[2] * p[2]
        areas[f] = 2 * np.arctan2(triple, 1 + cosines)
    return areas


def area_gradients(sphere: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Compute the gradient of every face's signed spherical area at its corners.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) int64 array

    Returns
    -------
    (F, 3, 3) float64 array
        Steradians per unit of length, in the order (face, corner, coordinate). Only the tangential
        part is meaningful.
    """
    corners = sphere[faces]
    following, preceding = np.roll(corners, -1, axis=1), np.roll(corners, 1, axis=1)
    triple = triple_products(sphere, faces)[:, None, None]
    chords = ((following - corners) ** 2).sum(axis=(1, 2))[:, None, None]
    cosines = 4 - chords / 2
    turned = cosines * np.cross(following, preceding) - triple * (following + preceding)
    gradients: NDArray[np.float64] = 2 * turned / (cosines**2 + triple**2)
    return gradients


def mean_square_distortion(
    sphere: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64]
) -> float:
    """Mean over the mesh of (r - 1)², r being the area of a face on the sphere by its own.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) int64 array
    areas : (F,) float64 array
        Of the faces on the mesh, summing to 4π.

    Returns
    -------
    float
    """
    excess = signed_spherical_areas(sphere, faces) - areas
    return float((excess**2 / areas).sum() / (4 * np.pi))


def flipped_faces(sphere: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Faces whose cone from the origin is degenerate or turned inside out, decided exactly.

    The sign of det[p, q, r] is taken in floating point where its error bound allows and in
    rational arithmetic elsewhere, so it holds for the coordinates exactly as stored.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Vectors from the origin; their lengths do not matter.
    faces : (F, 3) integer array

    Returns
    -------
    (F,) bool array
        True where det[p, q, r] <= 0.
    """
    p, q, r = (sphere[faces[:, k]] for k in range(3))
    a, b = q - p, r - p
    determinant = np.einsum("ij,ij->i", p, np.cross(a, b))
    permanent = np.abs(p[:, 0]) * (np.abs(a[:, 1] * b[:, 2]) + np.abs(a[:, 2] * b[:, 1]))
    permanent += np.abs(p[:, 1]) * (np.abs(a[:, 2] * b[:, 0]) + np.abs(a[:, 0] * b[:, 2]))
    permanent += np.abs(p[:, 2]) * (np.abs(a[:, 0] * b[:, 1]) + np.abs(a[:, 1] * b[:, 0]))
    # The differences a and b carry errors of their own, relative to the corners.
    scale = np.abs(p).max(1) * np.abs(a).max(1) * np.abs(b).max(1)
    rounding = np.abs(p).max(1) ** 2 * (np.abs(a).max(1) + np.abs(b).max(1))
    bound = _FILTER * (permanent + scale + rounding)
    flipped = determinant <= 0
    for face in np.flatnonzero(~(np.abs(determinant) > bound)):
        flipped[face] = _exact_determinant(sphere[faces[face]]) <= 0
    return flipped


def _exact_determinant(corners: NDArray[np.float64]) -> Fraction:
    if not np.isfinite(corners).all():
        return Fraction(0)
    (a, b, c), (d, e, f), (g, h, i) = (
        [Fraction(float(value)) for value in corner] for corner in corners
    )
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
