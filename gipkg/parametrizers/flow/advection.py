"""Points of the sphere advected by a field that is given at the vertices of a triangulation."""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled


@compiled
def advect(  # type: ignore[no-untyped-def]
    points, hosts, sphere, faces, twins, fluxes, densities, time, step
):
    """Move points by one step of Euler's method along flux / density.

    The density goes linearly in time from `densities` to 1. Flux and density are interpolated
    over the triangle that a point lies in, which is found by walking there from the last one.

    Parameters
    ----------
    points : (N, 3) float64 array
        Unit vectors; changed in place.
    hosts : (N,) int64 array
        The triangles that the points lie in, or lie near to; changed in place.
    sphere : (V, 3) float64 array
        Unit vectors, the vertices of a triangulation of the sphere.
    faces : (F, 3) int64 array
    twins : (3F,) int64 array
        Opposite half-edges.
    fluxes : (V, 3) float64 array
        Tangent vectors.
    densities : (V,) float64 array
        Positive.
    time, step : float
        Between 0 and 1.
    """
    weights = np.zeros(3)
    for n in range(len(points)):
        hosts[n] = _locate(points[n], hosts[n], sphere, faces, twins, weights)
        density = 0.0
        velocity = np.zeros(3)
        for k in range(3):
            v = faces[hosts[n], k]
            density += weights[k] * ((1 - time) * densities[v] + time)
            for c in range(3):
                velocity[c] += weights[k] * fluxes[v, c]
        radial = 0.0
        for c in range(3):
            radial += velocity[c] * points[n, c]
        speed = 0.0
        for c in range(3):
            velocity[c] = (velocity[c] - radial * points[n, c]) / density
            speed += velocity[c] ** 2
        speed = np.sqrt(speed)
        if speed > 0:
            # Along the great circle: exact for a rotation, and never off the sphere.
            cosine, sine = np.cos(step * speed), np.sin(step * speed) / speed
            norm = 0.0
            for c in range(3):
                points[n, c] = cosine * points[n, c] + sine * velocity[c]
                norm += points[n, c] ** 2
            for c in range(3):
                points[n, c] /= np.sqrt(norm)


@compiled
def _locate(point, host, sphere, faces, twins, weights):  # type: ignore[no-untyped-def]
    """Walk to the triangle around `point`; write its barycentric coordinates there.

    Every step crosses the edge that the point lies farthest beyond. Where that leads in
    circles, the walk ends after a while, and the coordinates are those of a nearby point.
    """
    for _ in range(len(faces)):
        worst = 0
        for k in range(3):
            q, r = sphere[faces[host, (k + 1) % 3]], sphere[faces[host, (k + 2) % 3]]
            weights[k] = _side(point, q, r)
            if weights[k] < weights[worst]:
                worst = k
        if weights[worst] >= 0:
            break
        host = twins[3 * host + (worst + 1) % 3] // 3
    total = 0.0
    for k in range(3):
        weights[k] = max(weights[k], 0.0)
        total += weights[k]
    for k in range(3):
        weights[k] = weights[k] / total if total > 0 else 1 / 3
    return host


@compiled
def _side(p, q, r):  # type: ignore[no-untyped-def]
    """Take the determinant of unit vectors, of their differences; positive left of q to r."""
    ax, ay, az = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    bx, by, bz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
    return p[0] * (ay * bz - az * by) + p[1] * (az * bx - ax * bz) + p[2] * (ax * by - ay * bx)
