"""3D Zernike moments of a polyhedron, integrated on its faces.

The 3D Zernike functions (Novotni & Klein 2004; Canterakis 1999) are polynomials of degree n,

    Z_nl^m(x) = c_n P_k^(0, l+1/2)(2|x|² - 1) e_l^m(x),    k = (n - l) / 2,

with a Jacobi polynomial P and a solid harmonic e_l^m, orthonormal over the unit ball with respect
to 3 / 4π times the volume. Along a ray from the origin every one of their terms is a power of
the distance, so that its integral over the cone of a face is an integral over the face, and that
is a Gauss rule. Unlike geometric moments, whose combination cancels almost all digits at order
20, nothing but the few radial coefficients is ill-conditioned.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import binom, roots_jacobi, roots_legendre

from gipkg.baselines.solid_harmonics import solid_harmonics

CHUNK = 8192
"""Quadrature points taken together, so that their harmonics stay in the cache."""


def zernike_moments(
    corners: NDArray[np.float64], order: int
) -> dict[tuple[int, int], NDArray[np.complex128]]:
    """Integrate the conjugate Zernike functions over the solid bounded by oriented triangles.

    Parameters
    ----------
    corners : (F, 3, 3) float64 array
        Corners of the triangles of a closed surface inside the unit ball, outward orientation.
    order : int
        Highest degree n.

    Returns
    -------
    dict
        (n, l) to the (2l + 1,) moments of m = -l, …, l, for l <= n <= order, n - l even. The unit
        ball has the moment 1 at n = l = 0 and 0 elsewhere.
    """
    # sums[l][v, m] integrates |x|^2v e_l^m over the faces, seen from the origin.
    sums = [
        np.zeros(((order - degree) // 2 + 1, degree + 1), dtype=complex)
        for degree in range(order + 1)
    ]
    for points, weights in _quadrature(corners, order):
        squares = np.einsum("pi,pi->p", points, points)
        powers = weights * squares ** np.arange(order // 2 + 1)[:, None]
        for terms, harmonics in zip(sums, solid_harmonics(points, order), strict=True):
            terms += powers[: len(terms)] @ harmonics.conj().T
    moments = {}
    for degree, terms in enumerate(sums):
        along_ray = terms / (degree + 2 * np.arange(len(terms)) + 3)[:, None]
        for k in range(len(terms)):
            upper = _radial(degree, k) @ along_ray[: k + 1] * (3 / (4 * math.pi))
            lower = (-1.0) ** np.arange(degree, 0, -1) * upper[:0:-1].conj()
            moments[degree + 2 * k, degree] = np.concatenate([lower, upper])
    return moments


def _radial(degree: int, k: int) -> NDArray[np.float64]:
    """Coefficients (k + 1,) of |x|^2v in the radial factor of Z_nl, l = degree, n = l + 2k."""
    v = np.arange(k + 1)
    norm = math.sqrt((2 * degree + 4 * k + 3) / 3)
    return norm * (-1.0) ** (k - v) * binom(k, v) * binom(k + degree + v + 0.5, k)


def _quadrature(
    corners: NDArray[np.float64], order: int
) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Yield points (P, 3) on the faces and weights (P,) that sum to six times a cone's volume.

    The full rule is exact. A face small against the waves of the polynomials gets a smaller
    one; measured at order 20, its moments are then within 1e-9 of its volume.
    """
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    exact = order // 2 + 1
    sizes = np.ceil(3.5 + order * edges / 2).astype(int).clip(max=exact)
    for size in np.unique(sizes):
        rule, rule_weights = _triangle_rule(int(size))
        selected = corners[sizes == size]
        step = max(1, CHUNK // len(rule))
        for begin in range(0, len(selected), step):
            faces = selected[begin : begin + step]
            weights = np.linalg.det(faces)[:, None] * rule_weights
            yield (rule @ faces).reshape(-1, 3), weights.ravel()


@lru_cache
def _triangle_rule(points: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Barycentric points (P², 3) and weights (P²,) of the reference triangle of area 1/2.

    The Gauss product in collapsed coordinates, exact for polynomials of degree 2P - 1.
    """
    s, s_weights = roots_jacobi(points, 1, 0)
    t, t_weights = roots_legendre(points)
    s, t = (s + 1) / 2, (t + 1) / 2
    first = np.repeat(s, points)
    second = (1 - first) * np.tile(t, points)
    barycentric = np.stack([first, second, 1 - first - second], axis=1)
    return barycentric, np.outer(s_weights / 4, t_weights / 2).ravel()
