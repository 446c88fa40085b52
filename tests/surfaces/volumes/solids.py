"""Voxel solids with known topology."""

from __future__ import annotations

import numpy as np

from gipkg.surfaces.volumes.lattice import Solid


def grid(size: int = 40) -> np.ndarray:
    """(3, size, size, size) coordinates about the centre."""
    return np.mgrid[:size, :size, :size] - (size - 1) / 2


def ball(radius: float, centre=(0.0, 0.0, 0.0), size: int = 40) -> Solid:
    offset = grid(size) - np.reshape(centre, (3, 1, 1, 1))
    return (offset**2).sum(axis=0) < radius**2


def ring(
    radius: float, tube: float, centre=(0.0, 0.0, 0.0), axis: int = 2, size: int = 40
) -> Solid:
    offset = list(grid() - np.reshape(centre, (3, 1, 1, 1)))
    along = offset.pop(axis)
    return (np.hypot(*offset) - radius) ** 2 + along**2 < tube**2


def blobs(seed: int, size: int = 16, smoothness: float = 1.0, share: float = 0.4) -> Solid:
    """Smoothed noise above a quantile: parts, cavities and tunnels of all kinds."""
    from scipy.ndimage import gaussian_filter

    noise = np.random.default_rng(seed).normal(size=(size, size, size))
    smooth = gaussian_filter(noise, smoothness)
    return smooth > np.quantile(smooth, 1 - share)
