"""Flesh on a skeleton: a smooth union of rounded cones, and its isosurface as a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.datasets.articulated.skeleton import Skeleton

CUTOFF = 6.0
"""The field of a bone ends where its distance is this many blending widths."""
FINEST = 0.75
"""Largest spacing in radii of the thinnest bone: finer than its radius, or it breaks."""
DENSITY = 2.0
"""Lattice cells on the surface for each vertex that is wanted, before it is decimated."""


def lattice_spacing(skeleton: Skeleton, size: int) -> float:
    """Spacing that resolves the thinnest bone, and leaves more than `size` vertices."""
    ends, radii = skeleton.cones()
    radius = radii.mean(axis=1)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    area = 2 * np.pi * (radius * (lengths + 2 * radius)).sum()
    return min(FINEST * skeleton.thinnest, float(np.sqrt(area / (DENSITY * size))))


def isosurface(
    skeleton: Skeleton, blending: float, spacing: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Mesh the smooth union of a skeleton's rounded cones by marching cubes.

    The union of distances d_i is -k log(sum exp(-d_i / k)), with k the blending width.

    Parameters
    ----------
    skeleton : Skeleton
    blending : float
        The width k, in the skeleton's units.
    spacing : float
        Distance of the lattice points.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array
        Oriented outwards.
    """
    from skimage.measure import marching_cubes

    ends, radii = skeleton.cones()
    margin = CUTOFF * blending + 2 * spacing
    reach = radii[..., None] + margin
    origin = (ends - reach).min(axis=(0, 1))
    ends = ends - origin
    shape = np.ceil((ends + reach).max(axis=(0, 1)) / spacing).astype(int) + 1
    low = ((ends - reach).min(axis=1) / spacing).astype(int)
    high = ((ends + reach).max(axis=1) / spacing).astype(int) + 1
    density = np.full(shape, np.exp(-CUTOFF), np.float32)
    for cone, cone_radii, first, last in zip(ends, radii, low, high, strict=True):
        x, y, z = (
            np.arange(*window, dtype=np.float32) * np.float32(spacing)
            for window in zip(first, last, strict=True)
        )
        distance = _rounded_cone(np.ix_(x, y, z), cone, cone_radii)
        density[tuple(map(slice, first, last))] += np.exp(-distance / np.float32(blending))

    field = -blending * np.log(density)
    # Vertices exactly on the lattice would give faces without area.
    vertices, faces, _, _ = marching_cubes(field, level=1e-4 * spacing, allow_degenerate=False)
    return vertices.astype(np.float64) * spacing + origin, faces.astype(np.int64)


def _rounded_cone(
    lattice: tuple[NDArray[np.float32], ...], ends: NDArray[np.float64], radii: NDArray[np.float64]
) -> NDArray[np.float32]:
    """Distance to the balls whose radius runs linearly from one end to the other."""
    bone = (ends[1] - ends[0]).astype(np.float32)
    x, y, z = (axis - np.float32(c) for axis, c in zip(lattice, ends[0], strict=True))
    squared = bone @ bone
    if squared > 0:
        along = np.clip((x * bone[0] + y * bone[1] + z * bone[2]) / squared, 0.0, 1.0)
    else:
        along = np.float32(0.0)
    x, y, z = (axis - along * length for axis, length in zip((x, y, z), bone, strict=True))
    first, last = radii.astype(np.float32)
    return np.sqrt(x * x + y * y + z * z) - (first + along * (last - first))
