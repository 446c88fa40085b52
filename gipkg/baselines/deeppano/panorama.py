"""How far a surface reaches from an axis, in all directions at all heights.

A ray is horizontal. So it meets a triangle where it meets the segment that the triangle has in
the plane of the ray's height, and one pass over triangles, their rows and the columns that their
segments span finds every intersection.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled


@compiled
def farthest_intersections(
    corners: NDArray[np.float64], rows: int, columns: int
) -> NDArray[np.float64]:
    """Return the distance from the z axis to the farthest intersection of each ray.

    Parameters
    ----------
    corners : (F, 3, 3) float64 array
        Corners of triangles.
    rows, columns : int
        Row i is the height 1 - (2 i + 1) / rows, column j the direction 2π j / columns.

    Returns
    -------
    (rows, columns) float64 array
        0 where a ray meets nothing.
    """
    depth = np.zeros((rows, columns))
    for triangle in corners:
        low, high = triangle[:, 2].min(), triangle[:, 2].max()
        first = max(0, math.floor((1 - high) * rows / 2 - 0.5))
        last = min(rows - 1, math.ceil((1 - low) * rows / 2 - 0.5))
        for row in range(first, last + 1):
            height = 1 - (2 * row + 1) / rows
            if low <= height < high:
                ax, ay, bx, by = _segment(triangle, height)
                _sweep(depth[row], ax, ay, bx, by)
    return depth


@compiled
def _segment(triangle: NDArray[np.float64], height: float) -> tuple[float, float, float, float]:
    """Return the ends, seen from above, of what a triangle has in a horizontal plane.

    A vertex in the plane is below it, so that two edges cross it and the third does not.
    """
    ends = np.zeros(4)
    found = 0
    for k in range(3):
        start, end = triangle[k], triangle[(k + 1) % 3]
        if (start[2] > height) == (end[2] > height):
            continue
        # From the lower end to the upper one, whichever triangle the edge is seen from.
        if start[2] > end[2]:
            start, end = end, start
        share = (height - start[2]) / (end[2] - start[2])
        ends[found] = start[0] + share * (end[0] - start[0])
        ends[found + 1] = start[1] + share * (end[1] - start[1])
        found += 2
    return ends[0], ends[1], ends[2], ends[3]


@compiled
def _sweep(depth: NDArray[np.float64], ax: float, ay: float, bx: float, by: float) -> None:
    """Enter a segment into the columns of a row that it spans, seen from the origin."""
    columns = len(depth)
    turn = ax * by - ay * bx
    if turn < 0:  # Counter-clockwise from a to b.
        ax, ay, bx, by, turn = bx, by, ax, ay, -turn
    farthest = math.sqrt(max(ax * ax + ay * ay, bx * bx + by * by))
    begin, end = _column(ax, ay, columns), _column(bx, by, columns)
    first, last = math.ceil(begin), math.floor(end)
    if end < begin:
        last += columns
    for column in range(first, last + 1):
        angle = 2 * math.pi * column / columns
        across = math.cos(angle) * (by - ay) - math.sin(angle) * (bx - ax)
        reach = farthest
        if turn < farthest * across:
            reach = turn / across
        cell = column % columns
        depth[cell] = max(depth[cell], reach)


@compiled
def _column(x: float, y: float, columns: int) -> float:
    """Return the direction of a point in columns, at least 0 and below their number."""
    position = math.atan2(y, x) * columns / (2 * math.pi)
    if position < 0:
        position += columns
    return position if position < columns else 0.0
