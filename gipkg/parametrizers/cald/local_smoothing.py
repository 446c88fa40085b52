"""Local smoothing of CALD: every vertex in turn improves the areas of its own star.

The faces around a vertex cover a region that is fixed by its ring, so what can be asked is that
they share it in proportion to their areas on the surface: one equation a face in the two
coordinates of the vertex, solved by least squares. Lengths are controlled at the same time: a
step must not stretch or shrink the worst face of the star beyond a limit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.cald.stars import Stars

_FLAT = 1e-15
"""Sine of a corner at which the sign of a triangle is no longer certain."""
_HALVINGS = 4
"""Lengths tried of a step."""
_GAIN = 1e-4
"""Relative gain of a star's area error below which its vertex stays."""


def smooth_locally(
    sphere: NDArray[np.float64],
    stars: Stars,
    areas: NDArray[np.float64],
    cotangents: NDArray[np.float64],
    length_limit: float,
    sweeps: int,
) -> None:
    """Move every vertex in turn, in place; flips become fewer, never more.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    stars : Stars
    areas : (F,) float64 array
        Of the faces on the surface, summing to 4π.
    cotangents : (F, 3) float64 array
        Of the angles of the faces on the surface.
    length_limit : float
        A step may change lengths within a star up to this factor. Where they are changed more
        than that already, it may not change them further.
    sweeps : int
        Over all vertices.
    """
    for _ in range(sweeps):
        _sweep(sphere, stars.offsets, stars.ring, stars.corners, areas, cotangents, length_limit)


@compiled
def _sweep(  # type: ignore[no-untyped-def]
    sphere, offsets, ring, corners, areas, cotangents, length_limit
):
    step, trial, basis = np.zeros(3), np.zeros(3), np.zeros((2, 3))
    for v in range(len(sphere)):
        neighbours = ring[offsets[v] : offsets[v + 1]]
        own = corners[offsets[v] : offsets[v + 1]]
        before = _measure(sphere[v], sphere, neighbours, own, areas, cotangents)
        gain = _area_step(sphere[v], sphere, neighbours, own, areas, basis, step)
        if before[0] == 0 and gain < _GAIN * before[1]:
            continue
        if not _try(v, step, trial, before, sphere, neighbours, own, areas, cotangents,
                    length_limit) and before[0] > 0:  # fmt: skip
            _ring_step(sphere[v], sphere, neighbours, step)
            _try(v, step, trial, before, sphere, neighbours, own, areas, cotangents,
                 length_limit)  # fmt: skip


@compiled
def _try(  # type: ignore[no-untyped-def]
    v, step, trial, before, sphere, ring, corners, areas, cotangents, length_limit
):
    """Make the step, or a half, a quarter, … of it, that improves the star; False if none does."""
    flips, error, worst = before
    limit = max(worst, length_limit)
    length = 1.0
    for _ in range(_HALVINGS):
        norm = 0.0
        for c in range(3):
            trial[c] = sphere[v, c] + length * step[c]
            norm += trial[c] ** 2
        for c in range(3):
            trial[c] /= np.sqrt(norm)
        now, less, longest = _measure(trial, sphere, ring, corners, areas, cotangents)
        if now < flips or (now == flips and less < error and (flips > 0 or longest <= limit)):
            for c in range(3):
                sphere[v, c] = trial[c]
            return True
        length *= 0.5
    return False


@compiled
def _measure(p, sphere, ring, corners, areas, cotangents):  # type: ignore[no-untyped-def]
    """Measure the star of a vertex at `p`: flips, area error, worst change of length.

    The area error is the sum of squared areas over surface areas, which is least where all
    have the same ratio, as their sum is given.
    """
    flips, error, worst = 0, 0.0, 0.0
    degree = len(ring)
    for i in range(degree):
        q, r = ring[i], ring[i + 1 if i + 1 < degree else 0]
        face, k = corners[i] // 3, corners[i] % 3
        a0, a1, a2 = sphere[q, 0] - p[0], sphere[q, 1] - p[1], sphere[q, 2] - p[2]
        b0, b1, b2 = sphere[r, 0] - p[0], sphere[r, 1] - p[1], sphere[r, 2] - p[2]
        n0, n1, n2 = a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0
        triple = p[0] * n0 + p[1] * n1 + p[2] * n2
        pq = a0 * a0 + a1 * a1 + a2 * a2
        pr = b0 * b0 + b1 * b1 + b2 * b2
        qr = (a0 - b0) ** 2 + (a1 - b1) ** 2 + (a2 - b2) ** 2
        # Chords |q - p|² of unit vectors give the cosines 1 - |q - p|² / 2 accurately.
        area = 2 * np.arctan2(triple, 4 - 0.5 * (pq + qr + pr))
        error += area * area / areas[face]
        if not (triple > 0 and triple * triple > _FLAT * _FLAT * pq * pr):
            flips += 1
            continue
        # Squared norm and determinant of the map of the face, then its singular values.
        norm = cotangents[face, k] * qr
        norm += cotangents[face, (k + 1) % 3] * pr + cotangents[face, (k + 2) % 3] * pq
        norm *= 0.5 / areas[face]
        determinant = 0.5 * np.sqrt(n0 * n0 + n1 * n1 + n2 * n2) / areas[face]
        root = np.sqrt(max(norm * norm - 4 * determinant * determinant, 0.0))
        largest = np.sqrt(0.5 * (norm + root))
        worst = max(worst, largest, largest / determinant)
    return flips, error, worst


@compiled
def _area_step(p, sphere, ring, corners, areas, basis, step):  # type: ignore[no-untyped-def]
    """Write the least-squares step in the tangent plane of `p`; return the predicted gain."""
    _tangent_basis(p, basis)
    g0, g1, h00, h01, h11 = 0.0, 0.0, 0.0, 0.0, 0.0
    degree = len(ring)
    for i in range(degree):
        q, r = ring[i], ring[i + 1 if i + 1 < degree else 0]
        q0, q1, q2 = sphere[q, 0], sphere[q, 1], sphere[q, 2]
        r0, r1, r2 = sphere[r, 0], sphere[r, 1], sphere[r, 2]
        n0, n1, n2 = q1 * r2 - q2 * r1, q2 * r0 - q0 * r2, q0 * r1 - q1 * r0
        # Of differences, as p lies close to the plane of q, r and the origin.
        triple = (p[0] - q0) * n0 + (p[1] - q1) * n1 + (p[2] - q2) * n2
        cosines = 1 + q0 * r0 + q1 * r1 + q2 * r2
        cosines += p[0] * (q0 + r0) + p[1] * (q1 + r1) + p[2] * (q2 + r2)
        scale = 2 / (cosines * cosines + triple * triple)
        s0 = scale * (cosines * n0 - triple * (q0 + r0))
        s1 = scale * (cosines * n1 - triple * (q1 + r1))
        s2 = scale * (cosines * n2 - triple * (q2 + r2))
        u = s0 * basis[0, 0] + s1 * basis[0, 1] + s2 * basis[0, 2]
        v = s0 * basis[1, 0] + s1 * basis[1, 1] + s2 * basis[1, 2]
        weight = 1 / areas[corners[i] // 3]
        pull = weight * 2 * np.arctan2(triple, cosines)
        g0 += pull * u
        g1 += pull * v
        h00 += weight * u * u
        h01 += weight * u * v
        h11 += weight * v * v
    determinant = h00 * h11 - h01 * h01
    if not determinant > 0:
        step[:] = 0
        return 0.0
    t0 = (h01 * g1 - h11 * g0) / determinant
    t1 = (h01 * g0 - h00 * g1) / determinant
    for c in range(3):
        step[c] = t0 * basis[0, c] + t1 * basis[1, c]
    return -(g0 * t0 + g1 * t1)


@compiled
def _tangent_basis(p, basis):  # type: ignore[no-untyped-def]
    """Write two orthonormal tangent vectors at `p`."""
    k = 0
    for c in range(1, 3):
        if abs(p[c]) < abs(p[k]):
            k = c
    norm = np.sqrt(1 - p[k] * p[k])
    for c in range(3):
        basis[0, c] = -p[k] * p[c] / norm
    basis[0, k] = norm
    basis[1, 0] = p[1] * basis[0, 2] - p[2] * basis[0, 1]
    basis[1, 1] = p[2] * basis[0, 0] - p[0] * basis[0, 2]
    basis[1, 2] = p[0] * basis[0, 1] - p[1] * basis[0, 0]


@compiled
def _ring_step(p, sphere, ring, step):  # type: ignore[no-untyped-def]
    """Write the step to the middle of the ring."""
    for c in range(3):
        total = 0.0
        for q in ring:
            total += sphere[q, c]
        step[c] = total / len(ring) - p[c]
