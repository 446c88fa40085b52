"""Generalised winding numbers, for the soups whose faces are oriented well enough."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces.volumes.lattice import Solid

SAMPLES = 4000
"""Voxels at which a soup's winding number is tried."""

WHOLE = 0.1
"""How near to a whole number a winding number counts as one."""

BLOCK = 1_000_000
"""Voxels that are looked at together, for the sake of memory."""

CONSISTENT = 0.9
"""Least share of the samples with a whole winding number; at fewer, it decides nothing."""


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
    places = np.flatnonzero(asked)
    if not len(places):
        return inside
    rng = np.random.default_rng(0)
    sample = rng.choice(places, min(SAMPLES, len(places)), replace=False)
    numbers = _numbers(vertices, faces, sample, asked.shape)
    whole = np.abs(numbers - np.round(numbers)) < WHOLE
    if whole.mean() >= CONSISTENT and (np.abs(numbers) > 0.5).any():
        for block in np.array_split(places, len(places) // BLOCK + 1):
            numbers = _numbers(vertices, faces, block, asked.shape)
            inside.ravel()[block] = np.abs(numbers) > 0.5
    return inside


def _numbers(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    places: NDArray[np.int64],
    shape: tuple[int, ...],
) -> NDArray[np.float64]:
    """Return the winding numbers of voxels, by their flat indices."""
    import igl

    points = np.column_stack(np.unravel_index(places, shape)).astype(np.float64)
    return np.asarray(igl.fast_winding_number(vertices, faces, points))
