"""The energy of one vertex's star on the sphere, and the descent that moves the vertex.

It is the energy of :mod:`gipkg.parametrizers.variational.energy` with two simplifications that
coarse levels need: a face is weighted by the area it carries, and its shape is held against an
equilateral triangle, since the coarse triangles themselves say little about the surface.
"""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.area_residual import area_residual

_EQUILATERAL = 1 / (2 * np.sqrt(3.0))
"""Squared edge lengths -> twice the Dirichlet energy of the map from an equilateral triangle."""
_LEAST = 1e-14
"""Triple products below this, in float64, have no certain sign."""
_TURN = 1e-3
"""A star's total area is fixed by its ring up to full turns of 4π; allowed round-off."""


@compiled
def star_energy(p, ring, targets, degree, shape):  # type: ignore[no-untyped-def]
    """Energy of a vertex at `p` (3,) inside its `ring` (degree, 3); also its total area.

    Infinite where a face of the star is not strictly counterclockwise.
    """
    energy, total = 0.0, 0.0
    px, py, pz = p
    for i in range(degree):
        j = i + 1 if i + 1 < degree else 0
        ax, ay, az = ring[i, 0] - px, ring[i, 1] - py, ring[i, 2] - pz
        bx, by, bz = ring[j, 0] - px, ring[j, 1] - py, ring[j, 2] - pz
        triple = px * (ay * bz - az * by) + py * (az * bx - ax * bz) + pz * (ax * by - ay * bx)
        if not triple > _LEAST:
            return np.inf, 0.0
        # Chords |q - p|² of unit vectors give the cosines 1 - |q - p|² / 2 accurately.
        pa = ax * ax + ay * ay + az * az
        pb = bx * bx + by * by + bz * bz
        ab = (ax - bx) ** 2 + (ay - by) ** 2 + (az - bz) ** 2
        area = 2 * np.arctan2(triple, 4 - 0.5 * (pa + pb + ab))
        conformal = _EQUILATERAL * (pa + pb + ab) / triple
        residual = area_residual(area / targets[i])[0]
        energy += targets[i] * (residual**2 + shape * (conformal - 1))
        total += area
    return energy, total


@compiled
def star_step(p, ring, targets, degree, shape, step):  # type: ignore[no-untyped-def]
    """Write a descent step in the tangent plane of `p`; return the predicted slope.

    Gauss-Newton in the area penalty and in the quadratic over linear conformal term.
    """
    # Tangent basis.
    basis = np.zeros((2, 3))
    k = 0
    if abs(p[1]) < abs(p[k]):
        k = 1
    if abs(p[2]) < abs(p[k]):
        k = 2
    for c in range(3):
        basis[0, c] = -p[k] * p[c]
    basis[0, k] += 1.0
    norm = np.sqrt(basis[0, 0] ** 2 + basis[0, 1] ** 2 + basis[0, 2] ** 2)
    for c in range(3):
        basis[0, c] /= norm
    basis[1, 0] = p[1] * basis[0, 2] - p[2] * basis[0, 1]
    basis[1, 1] = p[2] * basis[0, 0] - p[0] * basis[0, 2]
    basis[1, 2] = p[0] * basis[0, 1] - p[1] * basis[0, 0]

    g0, g1, h00, h01, h11 = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(degree):
        j = i + 1 if i + 1 < degree else 0
        q, r = ring[i], ring[j]
        cross = np.array(
            (
                q[1] * r[2] - q[2] * r[1],
                q[2] * r[0] - q[0] * r[2],
                q[0] * r[1] - q[1] * r[0],
            )
        )
        triple, pq, qr, rp = 0.0, 0.0, 0.0, 0.0
        for c in range(3):
            pq += p[c] * q[c]
            qr += q[c] * r[c]
            rp += r[c] * p[c]
        a0, a1, a2 = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        b0, b1, b2 = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        triple = p[0] * (a1 * b2 - a2 * b1) + p[1] * (a2 * b0 - a0 * b2)
        triple += p[2] * (a0 * b1 - a1 * b0)
        cosines = 1 + pq + qr + rp
        area = 2 * np.arctan2(triple, cosines)
        scale = 2 / (cosines * cosines + triple * triple)
        dirichlet = _EQUILATERAL * 2 * (3 - pq - qr - rp)
        a_u, a_v, t_u, t_v, d_u, d_v = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for c in range(3):
            da = scale * (cosines * cross[c] - triple * (q[c] + r[c]))
            dd = -2 * _EQUILATERAL * (q[c] + r[c])
            a_u += da * basis[0, c]
            a_v += da * basis[1, c]
            t_u += cross[c] * basis[0, c]
            t_v += cross[c] * basis[1, c]
            d_u += dd * basis[0, c]
            d_v += dd * basis[1, c]
        weight = targets[i]
        residual, growth = area_residual(area / weight)
        slope = 2 * residual * growth
        bend = 2 * growth**2 / weight
        conformal = weight * shape / triple
        mixed = conformal / triple
        turn = 2 * mixed * dirichlet / triple
        g0 += slope * a_u + conformal * d_u - mixed * dirichlet * t_u
        g1 += slope * a_v + conformal * d_v - mixed * dirichlet * t_v
        stiff = 4 * _EQUILATERAL * conformal
        h00 += bend * a_u * a_u + turn * t_u * t_u + stiff - 2 * mixed * t_u * d_u
        h01 += bend * a_u * a_v + turn * t_u * t_v - mixed * (t_u * d_v + t_v * d_u)
        h11 += bend * a_v * a_v + turn * t_v * t_v + stiff - 2 * mixed * t_v * d_v
    determinant = h00 * h11 - h01 * h01
    if not determinant > 0:
        return 0.0
    s0 = -(h11 * g0 - h01 * g1) / determinant
    s1 = -(h00 * g1 - h01 * g0) / determinant
    for c in range(3):
        step[c] = s0 * basis[0, c] + s1 * basis[1, c]
    return g0 * s0 + g1 * s1


@compiled
def descend(p, ring, targets, degree, shape, iterations):  # type: ignore[no-untyped-def]
    """Move `p` (3,) in place down the energy of its star, never through a flip.

    Returns the energy reached; infinite, and `p` untouched, if it starts at a flip.
    """
    step, trial = np.zeros(3), np.zeros(3)
    energy, total = star_energy(p, ring, targets, degree, shape)
    if energy == np.inf:
        return energy
    for _ in range(iterations):
        slope = star_step(p, ring, targets, degree, shape, step)
        if not slope < -1e-12 * energy:
            break
        length = np.sqrt(step[0] ** 2 + step[1] ** 2 + step[2] ** 2)
        t = min(1.0, 0.5 / length)
        improved = False
        for _ in range(12):
            norm = 0.0
            for c in range(3):
                trial[c] = p[c] + t * step[c]
                norm += trial[c] * trial[c]
            norm = np.sqrt(norm)
            for c in range(3):
                trial[c] /= norm
            new, new_total = star_energy(trial, ring, targets, degree, shape)
            if new < energy + 1e-4 * t * slope and abs(new_total - total) < _TURN:
                improved = True
                break
            t *= 0.5
        if not improved:
            break
        gain = energy - new
        for c in range(3):
            p[c] = trial[c]
        energy = new
        if gain < 1e-3 * energy:
            break
    return energy
