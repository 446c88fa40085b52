"""Any triangles to a solid, whatever gaps they leave and however they are oriented."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from gipkg.api import Volume
from gipkg.surfaces.soups.band import band_distances
from gipkg.surfaces.soups.winding import wound_around
from gipkg.surfaces.volumes.lattice import Solid

THICKNESS = np.sqrt(3) / 2
"""Distance, in voxels, from the triangles up to which everything is solid: the least at which no
sheet, however it lies, has holes in the lattice."""

MARGIN = 4
"""Empty voxels around the triangles."""

OFFSET = (0.31, 0.27, 0.23)
"""Where between voxels the box of the triangles begins: CAD models keep to planes of a grid."""


def voxelise(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], resolution: int
) -> tuple[Volume, Solid]:
    """Make a solid of any triangles.

    Solid is what is at most `THICKNESS` away from a triangle, what the outside cannot reach
    without coming so near, and what the triangles wind around. So a closed surface becomes a
    solid, gaps of less than `2 THICKNESS` do not matter, and what is no more than a sheet
    becomes a sheet of that thickness. All surfaces lie `THICKNESS` outside of the triangles.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
        They need no area, but the box around them needs a side.
    resolution : int
        Voxels along the longest side of the box.

    Returns
    -------
    volume : Volume
        Distances to the surface of the solid in voxels, positive inside, cut off where they
        are large.
    original : (X, Y, Z) bool array
        The voxels that are solid because of a triangle at hand; the border of the others
        closes a hole.
    """
    low = vertices.min(axis=0)
    spacing = float(np.ptp(vertices, axis=0).max()) / resolution
    first = MARGIN + np.array(OFFSET)
    points = (vertices - low) / spacing + first
    x, y, z = (np.ceil(points.max(axis=0)).astype(int) + MARGIN + 1).tolist()
    distance = band_distances(points, faces, (x, y, z))
    original = distance < THICKNESS
    regions, _ = ndimage.label(~original)
    outside = regions == regions[0, 0, 0]
    outside &= ~wound_around(points, faces, outside)
    values = np.where(outside | original, np.float32(THICKNESS) - distance, THICKNESS)
    origin = low - spacing * first
    return Volume(values, 0.0, spacing, tuple(origin.tolist())), original
