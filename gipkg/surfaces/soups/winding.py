"""Generalised winding numbers, for the soups whose faces are oriented well enough."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from gipkg.surfaces.volumes.lattice import Solid

STRIDE = 4
"""A soup's winding number is tried at every fourth voxel along each axis; where it is inside, all
voxels around are asked."""

WHOLE = 0.1
"""How near to a whole number a winding number counts as one."""

CONSISTENT = 0.9
"""Least share of those voxels with a whole winding number; at fewer, it decides nothing."""


def wound_around(vertices: NDArray[np.float64], faces: NDArray[np.int64], asked: Solid) -> Solid:
    """Tell which voxels lie inside by their winding number, where the soup has one that counts.

    Around closed and well oriented parts it is a whole number almost everywhere, and at holes
    it still tells both sides (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside
    Segmentation using Generalized Winding Numbers, SIGGRAPH 2013; evaluated as G. Barill et
    al., Fast Winding Numbers for Soups and Clouds, SIGGRAPH 2018). Bowls and faces without
    order have broken numbers; faces given twice, once from each side, have none at all. There
    the answer is that nothing is inside.

    Parameters
    ----------
    vertices : (V, 3) array
        In units of voxels.
    faces : (F, 3) array
    asked : (X, Y, Z) bool array
        The voxels in question.

    Returns
    -------
    (X, Y, Z) bool array
        Some of `asked`.
    """
    inside = np.zeros_like(asked)
    tried = asked[::STRIDE, ::STRIDE, ::STRIDE]
    numbers = _numbers(vertices, faces, STRIDE * np.argwhere(tried))
    whole = np.abs(numbers - np.round(numbers)) < WHOLE
    wound = np.zeros_like(tried)
    wound[tried] = np.abs(numbers) > 0.5
    if not wound.any() or whole.mean() < CONSISTENT:
        return inside
    around = ndimage.binary_dilation(wound, np.ones((3, 3, 3), bool))
    for axis in range(3):
        around = around.repeat(STRIDE, axis)
    places = np.argwhere(asked & around[tuple(slice(side) for side in asked.shape)])
    inside[tuple(places.T)] = np.abs(_numbers(vertices, faces, places)) > 0.5
    return inside


def _numbers(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], voxels: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the winding numbers of (n, 3) voxels."""
    import igl

    points = voxels.astype(np.float64)
    return np.asarray(igl.fast_winding_number(vertices, faces, points)).reshape(-1)
