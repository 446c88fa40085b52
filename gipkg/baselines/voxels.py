"""Closed meshes as solids on a cubic grid of voxels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gipkg.baselines.solids import require_solid

if TYPE_CHECKING:
    import trimesh


_SPACING = 0.5
"""Voxels between the points of a triangle whose voxels count as crossed, at most."""


def voxelise(corners: NDArray[np.float64], size: int) -> NDArray[np.bool_]:
    """Mark the voxels whose centres the surface winds around.

    What is enclosed twice is solid too. A column is decided at the edges of its triangles, each
    of which is evaluated alike in both triangles that share it, so that no column leaks.

    Parameters
    ----------
    corners : (F, 3, 3) float64 array
        Corners of the triangles of a closed surface, outward orientation, in voxels: the centre
        of voxel (i, j, k) is the point (i, j, k).
    size : int
        Voxels along a side.

    Returns
    -------
    (size, size, size) bool array
    """
    faces, columns = _columns_below(corners, size)
    turns = _winding(corners, faces, columns)
    hit = turns != 0
    faces, columns, turns = faces[hit], columns[hit], turns[hit]
    levels = np.clip(np.floor(_heights(corners, faces, columns)), -1, size - 1).astype(np.int64)
    # Level -1 is below the grid and covers no voxel.
    cells = np.ravel_multi_index((*columns.T, levels + 1), (size, size, size + 1))
    crossings = np.bincount(cells, turns, size * size * (size + 1))
    covers = crossings.reshape(size, size, size + 1)[:, :, :0:-1].cumsum(axis=2)
    return covers[:, :, ::-1] > 0


def _columns_below(
    corners: NDArray[np.float64], size: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """List the pairs of a triangle and a vertical column (i, j) in its bounding box."""
    low = np.clip(np.ceil(corners[:, :, :2].min(axis=1)), 0, size).astype(np.int64)
    high = np.clip(np.floor(corners[:, :, :2].max(axis=1)) + 1, 0, size).astype(np.int64)
    sides = np.maximum(high - low, 0)
    number = sides.prod(axis=1)
    faces = np.repeat(np.arange(len(corners)), number)
    places = np.arange(len(faces)) - np.repeat(number.cumsum() - number, number)
    return faces, low[faces] + np.stack(np.divmod(places, sides[faces, 1]), axis=1)


def _winding(
    corners: NDArray[np.float64], faces: NDArray[np.int64], columns: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Count how often the outline of each triangle winds around its column: -1, 0 or 1."""
    turns = np.zeros(len(faces), dtype=np.int64)
    x, y = columns.T
    for k in range(3):
        start, end = corners[:, k, :2], corners[:, (k + 1) % 3, :2]
        rises = start[:, 1] < end[:, 1]
        # From the lower end to the upper one, whichever triangle the edge is seen from.
        lower = np.where(rises[:, None], start, end)
        run, rise = (np.where(rises[:, None], end, start) - lower).T
        slope = np.divide(run, rise, out=np.zeros_like(run), where=rise > 0)
        (x0, y0), top = lower[faces].T, np.maximum(start, end)[faces, 1]
        crossed = (y0 <= y) & (y < top) & (x < x0 + (y - y0) * slope[faces])
        turns += np.where(rises, 1, -1)[faces] * crossed
    return turns


def _heights(
    corners: NDArray[np.float64], faces: NDArray[np.int64], columns: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return where columns pierce their triangles, never above or below the triangle."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[faces]
    rise = ((columns - corners[faces, 0, :2]) * normals[:, :2]).sum(axis=1)
    steep = normals[:, 2] == 0
    heights = corners[faces, 0, 2] - rise / np.where(steep, 1.0, normals[:, 2])
    bounds = corners[faces, :, 2]
    return np.clip(heights, bounds.min(axis=1), bounds.max(axis=1))


def crossed(corners: NDArray[np.float64], size: int) -> NDArray[np.bool_]:
    """Mark the voxels that a surface passes through, up to clipped corners.

    Parameters
    ----------
    corners : (F, 3, 3) float64 array
        Corners of triangles, in voxels, as for :func:`voxelise`.
    size : int
        Voxels along a side.

    Returns
    -------
    (size, size, size) bool array
    """
    marked = np.zeros((size, size, size), dtype=np.bool_)
    edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    pieces = np.maximum(np.ceil(edges / _SPACING), 1).astype(np.int64)
    for count in np.unique(pieces):
        first, second = np.array([(i, j) for i in range(count + 1) for j in range(count + 1 - i)]).T
        weights = np.stack([first, second, count - first - second], axis=1) / count
        points = np.einsum("pk,fkc->fpc", weights, corners[pieces == count]).reshape(-1, 3)
        voxels = np.rint(points).astype(np.int64)
        voxels = voxels[((voxels >= 0) & (voxels < size)).all(axis=1)]
        marked[tuple(voxels.T)] = True
    return marked


def turned_solids(mesh: trimesh.Trimesh, turns: int, size: int, extent: int) -> NDArray[np.bool_]:
    """Voxelise a mesh in equally spaced rotations about its z axis.

    Solid is what the surface encloses or passes through, as in the grids that these networks were
    made for: a part thinner than a voxel is not lost, a sheet is not empty. The bounding box of
    every rotation is centred in the grid. All have the same scale, by which the longest side of
    all their boxes covers `extent` voxels.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented outwards.
    turns : int
        Number R of rotations.
    size : int
        Voxels along a side, n.
    extent : int
        At most `size`.

    Returns
    -------
    (R, n, n, n) bool array

    Raises
    ------
    UnsupportedMesh
        The mesh encloses no positive volume.
    """
    require_solid(mesh)
    angles = 2 * np.pi * np.arange(turns) / turns
    cosines, sines = np.cos(angles), np.sin(angles)
    x, y, z = np.asarray(mesh.vertices, dtype=np.float64).T
    solids = np.zeros((turns, size, size, size), dtype=np.bool_)
    turned = np.stack(
        [
            np.outer(cosines, x) - np.outer(sines, y),
            np.outer(sines, x) + np.outer(cosines, y),
            np.broadcast_to(z, (turns, len(z))),
        ],
        axis=2,
    )
    low, high = turned.min(axis=1, keepdims=True), turned.max(axis=1, keepdims=True)
    turned = (turned - (low + high) / 2) * ((extent - 1) / (high - low).max()) + (size - 1) / 2
    for solid, vertices in zip(solids, turned, strict=True):
        corners = vertices[mesh.faces]
        solid[:] = voxelise(corners, size) | crossed(corners, size)
    return solids
