"""Displacements of vertices on a mesh, carried over to the sphere by barycentric coordinates.

A displaced vertex falls into one triangle of its one-ring; its place on the sphere is the
combination of that triangle's corners there, with the same coordinates (paper, Section 3, step
3). The coordinates are linear in the length of the displacement, so a step of any length follows
from two numbers a vertex: the rates at which those of the two other corners grow.
"""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled

_HALVINGS = 6
"""How often a vertex halves a step that does its star no good before it stays where it is."""
_REACH = 0.9
"""Share of the way to the opposite edge that a careful vertex goes at most."""
_ROUNDING = 16 * np.finfo(np.float64).eps
"""Triple products below this times the edges' lengths have no certain sign."""


@compiled
def destinations(faces, hats, displacements):  # type: ignore[no-untyped-def]
    """Find the triangle of the one-ring that each vertex is displaced into.

    Where the ring is not flat, the projections of a displacement may lie in several of its
    triangles or in none: the one it lies deepest in, by coordinates, is taken.

    Parameters
    ----------
    faces : (F, 3) int64 array
    hats : (F, 3, 3) float64 array
        Gradients of the barycentric coordinates on the mesh.
    displacements : (V, 3) float64 array

    Returns
    -------
    corners : (V,) int64 array
        3 f + k for a vertex that is corner k of its destination, face f.
    rates : (V, 2) float64 array
        Coordinates of the next and of the previous corner after a displacement of full
        length, never negative.
    """
    count = len(displacements)
    corners = np.zeros(count, np.int64)
    rates = np.zeros((count, 2))
    depths = np.full(count, -np.inf)
    for f in range(len(faces)):
        for k in range(3):
            v, j, i = faces[f, k], (k + 1) % 3, (k + 2) % 3
            ahead, behind = 0.0, 0.0
            for c in range(3):
                ahead += displacements[v, c] * hats[f, j, c]
                behind += displacements[v, c] * hats[f, i, c]
            size = abs(ahead) + abs(behind)
            depth = min(ahead, behind) / size if size > 0 else -1.0
            if depth > depths[v]:
                depths[v], corners[v] = depth, 3 * f + k
                rates[v, 0], rates[v, 1] = max(ahead, 0.0), max(behind, 0.0)
    return corners, rates


@compiled
def carry_all(sphere, faces, corners, rates, step):  # type: ignore[no-untyped-def]
    """Move all vertices at once, wherever that leaves the faces.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors; changed in place.
    faces : (F, 3) int64 array
    corners, rates : arrays
        Of :func:`destinations`.
    step : float
        Share of the displacement that is made, as far as the edge opposite to the vertex.
    """
    before = sphere.copy()
    for v in range(len(sphere)):
        rate = rates[v, 0] + rates[v, 1]
        if rate > 0:
            _place(before, faces, corners[v], rates[v], min(step, 1 / rate), v, sphere[v])


@compiled
def carry_carefully(  # type: ignore[no-untyped-def]
    sphere, faces, areas, fan_starts, fans, corners, rates, step
):
    """Move one vertex after the other, each as far as that evens out the areas of its star.

    A vertex halves its step until the distortion of the faces around it falls and none of them
    flips; their total distortion therefore falls too, and a bijection stays one.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors without flipped faces; changed in place.
    faces : (F, 3) int64 array
    areas : (F,) float64 array
        What the faces should measure.
    fan_starts, fans : (V + 1,), (3F,) int64 arrays
        ``fans[fan_starts[v]:fan_starts[v + 1]]`` are the corners at vertex v.
    corners, rates : arrays
        Of :func:`destinations`.
    step : float
        Share of the displacement that is tried first.

    Returns
    -------
    int
        How many vertices moved.
    """
    count = 0
    place = np.zeros(3)
    for v in range(len(sphere)):
        rate = rates[v, 0] + rates[v, 1]
        if not rate > 0:
            continue
        fan = fans[fan_starts[v] : fan_starts[v + 1]]
        length = min(step, _REACH / rate)
        before = _star_distortion(sphere[v], sphere, faces, areas, fan)
        for _ in range(_HALVINGS):
            _place(sphere, faces, corners[v], rates[v], length, v, place)
            if _star_distortion(place, sphere, faces, areas, fan) < before:
                sphere[v] = place
                count += 1
                break
            length /= 2
    return count


@compiled
def _place(sphere, faces, corner, rates, step, v, place):  # type: ignore[no-untyped-def]
    """Write where vertex `v` comes to lie on the sphere."""
    f, k = corner // 3, corner % 3
    ahead, behind = faces[f, (k + 1) % 3], faces[f, (k + 2) % 3]
    norm = 0.0
    for c in range(3):
        place[c] = sphere[v, c] + step * (
            rates[0] * (sphere[ahead, c] - sphere[v, c])
            + rates[1] * (sphere[behind, c] - sphere[v, c])
        )
        norm += place[c] ** 2
    norm = np.sqrt(norm)
    for c in range(3):
        place[c] /= norm


@compiled
def _star_distortion(p, sphere, faces, areas, fan):  # type: ignore[no-untyped-def]
    """Sum of (spherical area - area)² / area over a star with its vertex at `p`.

    Infinite where a face is not strictly counterclockwise.
    """
    distortion = 0.0
    for corner in fan:
        f, k = corner // 3, corner % 3
        q, r = sphere[faces[f, (k + 1) % 3]], sphere[faces[f, (k + 2) % 3]]
        ax, ay, az = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        bx, by, bz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        triple = p[0] * (ay * bz - az * by) + p[1] * (az * bx - ax * bz)
        triple += p[2] * (ax * by - ay * bx)
        # Chords |q - p|² of unit vectors give the cosines 1 - |q - p|² / 2 accurately.
        pq = ax * ax + ay * ay + az * az
        rp = bx * bx + by * by + bz * bz
        qr = (ax - bx) ** 2 + (ay - by) ** 2 + (az - bz) ** 2
        if not triple > _ROUNDING * (np.sqrt(pq) + np.sqrt(rp)):
            return np.inf
        area = 2 * np.arctan2(triple, 4 - 0.5 * (pq + qr + rp))
        distortion += (area - areas[f]) ** 2 / areas[f]
    return distortion
