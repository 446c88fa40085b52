"""Marching tetrahedra: the surface between the solid and the other voxels.

It has exactly the topology that the Freudenthal lattice gives to the voxels, always closed and
manifold (after A. Doi, A. Koide, An Efficient Method of Triangulating Equi-Valued Surfaces by
Using Tetrahedral Cells, IEICE Transactions E74, 1991).
"""

from __future__ import annotations

from functools import cache
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces.volumes.lattice import CORNERS, Solid

NEAREST = 0.1
"""Least distance of a surface vertex from a voxel, as a share of the lattice edge it is on:
nearer, and the triangles around the voxel would have no area."""


def lattice_surface(
    solid: Solid, depth: NDArray[np.float32]
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Triangulate the border of a set of voxels.

    The topology is that of `solid`; `depth` only says where on a lattice edge the surface
    runs. Where the two contradict each other, it is the middle.

    Parameters
    ----------
    solid : (X, Y, Z) bool array
        Without a solid voxel on the array's border.
    depth : (X, Y, Z) float array
        Positive inside, negative outside.

    Returns
    -------
    vertices : (V, 3) array
        In units of voxels.
    faces : (F, 3) array
        Closed, manifold, oriented outward.
    owner : (V,) array
        Flat index of the solid voxel that each vertex is next to.
    """
    vertices, owner, faces = _march(solid, depth, *_cases())
    return vertices, faces, owner


@cache
def _cases() -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """List the triangles of every tetrahedron of a cube and every pattern of solid corners.

    Returns
    -------
    tetrahedra : (6, 4) array
        Corners of the cube.
    count : (6, 16) array
        Triangles; bit i of the pattern: corner i of the tetrahedron is solid.
    edges : (6, 16, 2, 3, 2) array
        For each corner of each triangle the lower and the upper corner of the cube between
        which it lies.
    """
    tetrahedra = np.array([np.cumsum([0, *steps]) for steps in permutations((1, 2, 4))])
    count = np.zeros((6, 16), np.int64)
    edges = np.zeros((6, 16, 2, 3, 2), np.int64)
    for number, tetrahedron in enumerate(tetrahedra.tolist()):
        for pattern in range(1, 15):
            polygon = _polygon(tetrahedron, pattern)
            count[number, pattern] = len(polygon) - 2
            for triangle in range(len(polygon) - 2):
                corners = (polygon[0], polygon[triangle + 1], polygon[triangle + 2])
                edges[number, pattern, triangle] = [sorted(pair) for pair in corners]
    return tetrahedra, count, edges


def _polygon(tetrahedron: list[int], pattern: int) -> list[tuple[int, int]]:
    """Return the edges of a tetrahedron that the surface crosses, counterclockwise."""
    solid = [corner for i, corner in enumerate(tetrahedron) if pattern >> i & 1]
    empty = [corner for i, corner in enumerate(tetrahedron) if not pattern >> i & 1]
    polygon = [(one, other) for one in solid for other in empty]
    if len(polygon) == 4:
        polygon[2:] = polygon[:1:-1]
    points = CORNERS[polygon].mean(axis=1)
    normal = np.cross(points[1] - points[0], points[2] - points[0])
    outward = CORNERS[empty].mean(axis=0) - CORNERS[solid].mean(axis=0)
    return polygon if normal @ outward > 0 else polygon[::-1]


@compiled
def _march(solid, depth, tetrahedra, count, edges):  # type: ignore[no-untyped-def]
    """Gather the triangles of all cubes; crossed edges are known by lower voxel and step."""
    nx, ny, nz = solid.shape
    start = np.zeros(solid.shape, np.int32)
    total = size = 0
    for x in range(nx - 1):
        for y in range(ny - 1):
            for z in range(nz - 1):
                pattern = _pattern(solid, x, y, z)
                start[x, y, z] = total
                total += _crossed(pattern, 8)
                for t in range(6):
                    size += count[t, _case(pattern, tetrahedra[t])]
    vertices = np.empty((total, 3))
    owner = np.empty(total, np.int64)
    faces = np.empty((size, 3), np.int64)
    size = 0
    for x in range(nx - 1):
        for y in range(ny - 1):
            for z in range(nz - 1):
                pattern = _pattern(solid, x, y, z)
                if pattern == 0 or pattern == 255:
                    continue
                _place(solid, depth, x, y, z, pattern, start[x, y, z], vertices, owner)
                for t in range(6):
                    case = _case(pattern, tetrahedra[t])
                    for n in range(count[t, case]):
                        for k in range(3):
                            low, high = edges[t, case, n, k]
                            a, b, c = x + (low & 1), y + (low >> 1 & 1), z + (low >> 2 & 1)
                            local = _pattern(solid, a, b, c) if low else pattern
                            faces[size, k] = start[a, b, c] + _crossed(local, high ^ low)
                        size += 1
    return vertices, owner, faces


@compiled
def _case(pattern, tetrahedron):  # type: ignore[no-untyped-def]
    """Return the solid corners of one tetrahedron of a cube, as bits."""
    case = 0
    for i in range(4):
        case |= (pattern >> tetrahedron[i] & 1) << i
    return case


@compiled
def _pattern(solid, x, y, z):  # type: ignore[no-untyped-def]
    """Return the solid corners of the cube above a voxel, as bits."""
    pattern = 0
    for corner in range(8):
        a, b, c = x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1)
        if a < solid.shape[0] and b < solid.shape[1] and c < solid.shape[2]:
            pattern |= solid[a, b, c] << corner
    return pattern


@compiled
def _crossed(pattern, end):  # type: ignore[no-untyped-def]
    """Count the steps below `end` from a cube's lowest corner that cross the surface."""
    crossed = 0
    for step in range(1, end):
        crossed += (pattern >> step & 1) != (pattern & 1)
    return crossed


@compiled
def _place(solid, depth, x, y, z, pattern, vertex, vertices, owner):  # type: ignore[no-untyped-def]
    """Place the vertices on the crossed edges from one voxel."""
    for step in range(1, 8):
        if (pattern >> step & 1) == (pattern & 1):
            continue
        a, b, c = x + (step & 1), y + (step >> 1 & 1), z + (step >> 2 & 1)
        sign = 1 if pattern & 1 else -1
        near, far = sign * depth[x, y, z], sign * depth[a, b, c]
        share = 0.5
        if near > 0 > far:
            share = min(max(near / (near - far), NEAREST), 1 - NEAREST)
        vertices[vertex, 0] = x + share * (a - x)
        vertices[vertex, 1] = y + share * (b - y)
        vertices[vertex, 2] = z + share * (c - z)
        if pattern & 1:
            a, b, c = x, y, z
        owner[vertex] = (a * solid.shape[1] + b) * solid.shape[2] + c
        vertex += 1
