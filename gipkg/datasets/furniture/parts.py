"""What furniture is put together from: lofts, tubes, slabs, sheets, and boxes united to a solid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Points = NDArray[np.float64]
Span = tuple[float, float]
Box = tuple[Span, Span, Span]
"""From where to where along x, y and z."""

GRAIN = 1e-5
"""Boxes whose sides are nearer than this meet."""


@dataclass(frozen=True, slots=True)
class Part:
    """Triangles in pairs: faces 2i and 2i + 1 are a quadrilateral, but for the ends of a loft."""

    vertices: Points
    faces: NDArray[np.int64]

    def moved(self, offset: ArrayLike) -> Part:
        """Return a copy elsewhere."""
        return Part(self.vertices + np.asarray(offset, float), self.faces)

    def turned(self, angle: float, axis: int = 2, pivot: ArrayLike = (0.0, 0.0, 0.0)) -> Part:
        """Return a copy turned by an angle in radians around an axis through a pivot."""
        first, second = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[first, first] = turn[second, second] = np.cos(angle)
        turn[second, first] = np.sin(angle)
        turn[first, second] = -turn[second, first]
        pivot = np.asarray(pivot, float)
        return Part((self.vertices - pivot) @ turn.T + pivot, self.faces)


def ring(
    width: float, depth: float, height: float, squareness: float = 0.0, corners: int = 20
) -> Points:
    """Return a level outline around the z axis: an ellipse, or nearly a rectangle towards 1."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5) / corners
    outline = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outline = np.sign(outline) * np.abs(outline) ** (1.0 - squareness)
    return np.column_stack([outline * [width / 2, depth / 2], np.full(corners, height)])


def loft(sections: Sequence[Points] | Points) -> Part:
    """Span a closed surface over outlines of equally many points, and close both ends."""
    rows = np.asarray(sections, float)
    vertices, faces = _grid(np.concatenate([rows, rows[:, :1]], axis=1))
    vertices = vertices.reshape(len(rows), -1, 3)[:, :-1].reshape(-1, 3)
    count = rows.shape[1]
    faces = faces // (count + 1) * count + faces % (count + 1) % count
    around = np.arange(count)
    last = (len(rows) - 1) * count
    first_end = np.stack([np.roll(around, -1), around, np.full(count, len(vertices))], axis=1)
    last_end = np.stack([around, np.roll(around, -1), np.full(count, len(vertices) + 1 - last)], 1)
    faces = np.concatenate([faces, first_end, last_end + last])
    vertices = np.concatenate([vertices, rows[0].mean(axis=0)[None], rows[-1].mean(axis=0)[None]])
    return Part(vertices, faces if _volume(vertices, faces) > 0 else faces[:, ::-1])


def turned_profile(
    profile: ArrayLike, squareness: float = 0.0, stretch: float = 1.0, corners: int = 20
) -> Part:
    """Span a loft over horizontal outlines, as a lathe makes it.

    Parameters
    ----------
    profile : (n, 2) array-like
        Width and height of each outline, from below; turning back down inside makes a basin.
    squareness : float
        Of the outlines, from 0, an ellipse, to nearly 1.
    stretch : float
        Depth of an outline, along y, in its widths.
    corners : int
        Of an outline.
    """
    return loft(
        [
            ring(width, width * stretch, height, squareness, corners)
            for width, height in np.asarray(profile, float)
        ]
    )


def tube(path: ArrayLike, thickness: float | Sequence[float], corners: int = 8) -> Part:
    """Sweep a disc of a thickness, that may change, along (n, 3) points."""
    points = np.asarray(path, float)
    radii = np.broadcast_to(thickness, len(points)) / 2
    tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    aside = np.eye(3)[np.abs(tangents).max(axis=0).argmin()]
    first = np.cross(tangents, aside)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(tangents, first)
    angle = 2 * np.pi * (np.arange(corners) + 0.5) / corners
    discs = np.cos(angle)[:, None] * first[:, None] + np.sin(angle)[:, None] * second[:, None]
    return loft(points[:, None] + radii[:, None, None] * discs)


def slab(curve: ArrayLike, thickness: float, width: Span) -> Part:
    """Thicken a curve in the y-z plane and extend it along x: a bent board.

    Parameters
    ----------
    curve : (n, 2) array-like
        The middle of the board, as y and z.
    thickness : float
    width : (float, float)
        From where to where along x.
    """
    middle = np.asarray(curve, float)
    tangents = np.gradient(middle, axis=0)
    normals = np.stack([-tangents[:, 1], tangents[:, 0]], axis=1)
    normals *= thickness / 2 / np.linalg.norm(normals, axis=1, keepdims=True)
    low, high = middle - normals, middle + normals
    corners = [(width[0], low), (width[1], low), (width[1], high), (width[0], high)]
    return loft(
        np.stack(
            [np.column_stack([np.full(len(at), x), at]) for x, at in corners],
            axis=1,
        )
    )


def sheet(points: ArrayLike) -> Part:
    """Span an open surface without thickness over an (m, n, 3) grid of points."""
    return Part(*_grid(np.asarray(points, float)))


def box(sides: Box) -> Part:
    """Return a box with the sides along the axes."""
    return unite([sides])


def unite(boxes: Sequence[Box]) -> Part:
    """Unite boxes to a solid: the surface between the cells that any box fills and the others.

    The sides of all boxes cut space into cells. Solids that meet at an edge alone share it.
    """
    sides = np.round(np.asarray(boxes, float) / GRAIN) * GRAIN
    planes = [np.unique(sides[:, axis]) for axis in range(3)]
    filled = np.zeros([len(along) + 1 for along in planes], dtype=np.int8)
    for one in sides:
        spans = zip(planes, one, strict=True)
        cells = (1 + np.searchsorted(along, span) for along, span in spans)
        filled[tuple(slice(*ends) for ends in cells)] = 1
    corners = [_quads(filled, axis, sign) for axis in range(3) for sign in (-1, 1)]
    used, faces = np.unique(
        np.ravel_multi_index(tuple(np.concatenate(corners).T), [len(p) for p in planes]),
        return_inverse=True,
    )
    where = np.unravel_index(used, [len(along) for along in planes])
    vertices = np.stack([along[at] for along, at in zip(planes, where, strict=True)], axis=1)
    quads = faces.reshape(-1, 4)
    return Part(vertices, quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3))


def _quads(filled: NDArray[np.int8], axis: int, sign: int) -> NDArray[np.int64]:
    """Return the corners, as (4 n, 3) numbers of planes, of the faces that look along an axis."""
    at = np.argwhere(np.diff(filled, axis=axis) == -sign)
    ahead = np.roll(np.array([0, 1, 0]), axis)
    above = np.roll(np.array([0, 0, 1]), axis)
    at = at - ahead - above
    round_trip = [at, at + ahead, at + ahead + above, at + above]
    return np.stack(round_trip[::sign], axis=1).reshape(-1, 3)


def _grid(points: Points) -> tuple[Points, NDArray[np.int64]]:
    rows, columns, _ = points.shape
    number = np.arange(rows * columns).reshape(rows, columns)
    corners = [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]]
    quads = np.stack([corner.ravel() for corner in corners], axis=1)
    return points.reshape(-1, 3), quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def _volume(vertices: Points, faces: NDArray[np.int64]) -> float:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
