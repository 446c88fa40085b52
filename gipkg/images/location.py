"""Point location on a triangulated sphere, by walking from face to face."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces.halfedges import twins


def locate(
    sphere: NDArray[np.float64],
    faces: NDArray[np.integer],
    directions: NDArray[np.float64],
    width: int,
) -> tuple[NDArray[np.int32], NDArray[np.float64], int]:
    """Find the spherical triangle that contains each direction, and its weights there.

    From the face of the previous direction the walk crosses the edge that the direction is
    farthest beyond, until there is none. Neighbouring pixels are mostly in the same or an
    adjacent face, so this takes about one step, however thin or small the faces. Where the
    map folds, a walk may circle; it is given up after F steps for a search of all faces.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) integer array
        Closed, manifold and oriented.
    directions : (N, 3) float64 array
        Unit vectors in reading order.
    width : int
        Directions in a row: after a row's end, the walk goes on from the row's beginning.

    Returns
    -------
    face : (N,) int32 array
    weights : (N, 3) float64 array
        At least 0, sum 1: the barycentric coordinates in the flat triangle of the point that
        the direction's ray meets. They are continuous across edges.
    uncovered : int
        Index of a direction that no positively oriented face comes within `REACH` of, whose
        search ended the work; -1 if there is none.
    """
    corners = np.ascontiguousarray(faces, dtype=np.int64)
    neighbours = twins(corners).reshape(-1, 3) // 3
    points = np.ascontiguousarray(sphere, dtype=np.float64)
    return _locate(points, corners, neighbours, directions, width)


REACH = 1e-9
"""Radians by which round-off may put a direction outside all faces around it."""


@compiled
def _locate(sphere, faces, neighbours, directions, width):  # type: ignore[no-untyped-def]
    count = len(directions)
    face = np.zeros(count, np.int32)
    weights = np.zeros((count, 3))
    for i in range(count):
        start = 0
        if i % width:
            start = face[i - 1]
        elif i:
            start = face[i - width]
        found = _walk(sphere, faces, neighbours, directions[i], start, weights[i])
        if found < 0:
            found = _search(sphere, faces, directions[i], weights[i])
        if found < 0:
            return face, weights, i
        face[i] = found
        weights[i] /= weights[i].sum()
    return face, weights, -1


@compiled
def _walk(sphere, faces, neighbours, d, face, weights):  # type: ignore[no-untyped-def]
    """Walk to the face that contains `d`; -1 if the walk does not arrive."""
    for _ in range(len(faces)):
        a, b, c = faces[face]
        weights[0] = _side(sphere, b, c, d)
        weights[1] = _side(sphere, c, a, d)
        weights[2] = _side(sphere, a, b, d)
        farthest = np.argmin(weights)
        if weights[farthest] >= 0:
            # A face turned inside out contains the directions opposite to it.
            return face if _turns_left(sphere, a, b, c) else -1
        face = neighbours[face, (farthest + 1) % 3]
    return -1


@compiled
def _search(sphere, faces, d, weights):  # type: ignore[no-untyped-def]
    """Find the face whose nearest point by clipped weights is closest; -1 beyond reach."""
    best = -1
    least = REACH
    trial = np.zeros(3)
    for face in range(len(faces)):
        a, b, c = faces[face]
        if not _turns_left(sphere, a, b, c):
            continue
        trial[0] = max(_side(sphere, b, c, d), 0.0)
        trial[1] = max(_side(sphere, c, a, d), 0.0)
        trial[2] = max(_side(sphere, a, b, d), 0.0)
        if trial.sum() <= 0:
            continue
        point = trial[0] * sphere[a] + trial[1] * sphere[b] + trial[2] * sphere[c]
        distance = np.linalg.norm(point / np.linalg.norm(point) - d)
        if distance < least:
            best, least = face, distance
            weights[:] = trial
    return best


@compiled
def _side(sphere, i, j, d):  # type: ignore[no-untyped-def]
    """Return det[p_i, p_j, d], positive where `d` is to the left of the edge from i to j.

    It is taken of differences, which keeps its accuracy next to a short edge, and always in
    the same order, so that the two faces of an edge never disagree.
    """
    if i > j:
        return -_side_ordered(sphere[j], sphere[i], d)
    return _side_ordered(sphere[i], sphere[j], d)


@compiled
def _side_ordered(p, q, d):  # type: ignore[no-untyped-def]
    x0, x1, x2 = p[0] - d[0], p[1] - d[1], p[2] - d[2]
    y0, y1, y2 = q[0] - d[0], q[1] - d[1], q[2] - d[2]
    return d[0] * (x1 * y2 - x2 * y1) + d[1] * (x2 * y0 - x0 * y2) + d[2] * (x0 * y1 - x1 * y0)


@compiled
def _turns_left(sphere, a, b, c):  # type: ignore[no-untyped-def]
    return _side_ordered(sphere[b], sphere[c], sphere[a]) > 0
