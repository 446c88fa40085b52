"""Handles cut open along their shortest loop, and both sides capped."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces import halfedges
from gipkg.surfaces.holes import border_loops, close_loop
from gipkg.surfaces.loops import shortest_nonseparating_loop
from gipkg.surfaces.splitting import split_fans
from gipkg.surfaces.triangles import Triangles

SEPARATION = 0.01
"""How far the two sides of a cut draw back, of the way to their neighbours: enough that no
reader that merges coinciding vertices sews them together again."""

BULGE = 0.25
"""How far a cap's middle draws back into its side, of the same way."""


def genus(mesh: Triangles) -> int:
    """Return the genus of a closed, manifold, oriented surface of one component."""
    return (2 - len(mesh.vertices) + len(mesh.faces) // 2) // 2


def remove_handles(mesh: Triangles) -> tuple[Triangles, list[float]]:
    """Reduce a closed surface of one component to genus 0.

    Each cut along a loop that does not separate the surface, with both sides capped, lowers
    the genus by one. Whether that opens a handle's ring or closes its tunnel is decided by
    which of the two is shorter.

    Returns
    -------
    mesh : Triangles
    lengths : list of float
        Length of each loop.
    """
    lengths = []
    for _ in range(genus(mesh)):
        loop = shortest_nonseparating_loop(mesh.vertices, mesh.faces)
        points = mesh.vertices[loop]
        lengths.append(float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum()))
        mesh = _cut_and_cap(mesh, loop)
    return mesh, lengths


def _cut_and_cap(mesh: Triangles, loop: NDArray[np.int64]) -> Triangles:
    pairs = halfedges.group_edges(mesh.faces).pairs()
    opened, _ = split_fans(mesh, pairs[~_runs_along(mesh.faces, pairs[:, 0], loop)])
    borders = border_loops(opened.faces)
    backward = [_way_back(opened, border) for border in borders]
    vertices = opened.vertices.copy()
    for border, way in zip(borders, backward, strict=True):
        vertices[border] += SEPARATION * way
    closed = Triangles(vertices, opened.faces, opened.original)
    for border, way in zip(borders, backward, strict=True):
        closed = close_loop(closed, border, BULGE * way.mean(axis=0))
    return closed


def _runs_along(
    faces: NDArray[np.int64], chosen: NDArray[np.int64], loop: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Mark those of the half-edges that join two successive vertices of the loop."""
    origin, target = halfedges.endpoints(faces)
    following = np.roll(loop, -1)
    width = int(faces.max()) + 1
    wanted = np.minimum(loop, following) * width + np.maximum(loop, following)
    a, b = origin[chosen], target[chosen]
    return np.isin(np.minimum(a, b) * width + np.maximum(a, b), wanted)


def _way_back(mesh: Triangles, border: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return (n, 3) ways from the border to the mean of each vertex's neighbours off it."""
    place = np.full(len(mesh.vertices), -1)
    place[border] = np.arange(len(border))
    origin, target = halfedges.endpoints(mesh.faces)
    inward = (place[origin] >= 0) & (place[target] < 0)
    at, towards = place[origin[inward]], mesh.vertices[target[inward]]
    count = np.bincount(at, minlength=len(border))
    total = np.column_stack([np.bincount(at, towards[:, k], len(border)) for k in range(3)])
    mean = np.divide(total, count[:, None], out=mesh.vertices[border], where=count[:, None] > 0)
    return mean - mesh.vertices[border]
