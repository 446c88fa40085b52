"""Distances from the voxels near a surface to it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces.volumes.lattice import CORNERS

BAND = 1.5 * np.sqrt(3)
"""Distance, in voxels, up to which distances are computed; farther voxels get this one. A lattice
edge that leaves the solid, which is half a diagonal thick, ends at most a whole one farther out."""

COARSEST = 8
"""Voxels along a side of the blocks that the search begins with; a power of two."""


def band_distances(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], shape: tuple[int, int, int]
) -> NDArray[np.float32]:
    """Compute the distance of every voxel to a surface, up to `BAND`.

    Blocks of voxels that are farther away are left out as a whole, so that time grows with
    the area of the surface and not with the volume around it.

    Parameters
    ----------
    vertices : (V, 3) array
        In units of voxels.
    faces : (F, 3) array
        Any triangles.
    shape : three ints
        Of the array of voxels.

    Returns
    -------
    (X, Y, Z) array
        In units of voxels.
    """
    import igl

    tree = igl.AABB()
    tree.init(vertices, faces)
    result = np.full(shape, BAND, np.float32)
    side = COARSEST
    blocks = np.argwhere(np.ones(-(-np.array(shape) // side), bool)) * side
    while True:
        # A block of one voxel is the point at its centre.
        squared, _, _ = tree.squared_distance(vertices, faces, blocks + (side - 1) / 2)
        distance = np.sqrt(squared)
        if side == 1:
            result[tuple(blocks.T)] = np.minimum(distance, BAND)
            return result
        near = distance < BAND + np.sqrt(3) / 2 * (side - 1)
        side //= 2
        blocks = (blocks[near][:, None] + side * CORNERS).reshape(-1, 3)
        blocks = blocks[(blocks < shape).all(axis=1)]
