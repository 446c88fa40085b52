"""Tangent planes of the unit sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def tangent_basis(sphere: NDArray[np.float64]) -> NDArray[np.float64]:
    """Find two orthonormal tangent vectors at every point: (V, 3) -> (V, 2, 3)."""
    axis = np.eye(3)[np.abs(sphere).argmin(axis=1)]
    first = axis - sphere * np.einsum("ij,ij->i", axis, sphere)[:, None]
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack((first, np.cross(sphere, first)), axis=1)


def move(
    sphere: NDArray[np.float64], basis: NDArray[np.float64], coordinates: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Go along tangent coordinates (2V,) and back to the sphere: (V, 3)."""
    moved = sphere + np.einsum("vd,vdc->vc", coordinates.reshape(-1, 2), basis)
    moved /= np.linalg.norm(moved, axis=1, keepdims=True)
    return moved
