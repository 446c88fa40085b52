"""Where a surface is looked at from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

_STANDING = (1.0, -2.0, 0.6)
"""Direction from a shape that stands upright to the eye."""


@dataclass(frozen=True, slots=True)
class Camera:
    """A parallel projection: equal lengths look equal, near and far.

    Attributes
    ----------
    centre : (3,) float64 array
        Point in the middle of the picture.
    towards_eye : (3,) float64 array
        Unit vector from the surface to the eye.
    up : (3,) float64 array
        Unit vector, at right angles to `towards_eye`.
    half_height : float
        Distance from the middle of the picture to its upper edge, in the surface's units.
    """

    centre: NDArray[np.float64]
    towards_eye: NDArray[np.float64]
    up: NDArray[np.float64]
    half_height: float

    @property
    def axes(self) -> NDArray[np.float64]:
        """Unit vectors (3, 3), as rows: to the right, upward, to the eye."""
        return np.stack([np.cross(self.up, self.towards_eye), self.up, self.towards_eye])


def camera_on(
    points: NDArray[np.floating],
    towards_eye: ArrayLike,
    up: ArrayLike,
    aspect: float = 1.0,
    margin: float = 0.04,
) -> Camera:
    """Place a camera so that all points are just inside its picture.

    Parameters
    ----------
    points : (N, 3) array
    towards_eye : (3,) array_like
        Direction from the points to the eye, of any length.
    up : (3,) array_like
        What is upward in the picture; it need not be at right angles to `towards_eye`.
    aspect : float
        Width of the picture over its height.
    margin : float
        Share of the picture left free at each side.
    """
    forward = np.asarray(towards_eye, dtype=np.float64)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(np.asarray(up, dtype=np.float64), forward)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(forward, right), forward])
    seen = np.asarray(points, dtype=np.float64) @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    width, height, _ = (high - low) / 2
    half_height = max(height, width / aspect) / (1 - 2 * margin)
    return Camera((low + high) / 2 @ axes, forward, axes[1], float(half_height))


def standing_camera(points: NDArray[np.floating]) -> Camera:
    """Look from the front, a little from the right and from above, at points with z upward.

    Parameters
    ----------
    points : (N, 3) array
    """
    return camera_on(points, _STANDING, up=[0, 0, 1])


def principal_camera(
    points: NDArray[np.floating], aspect: float = 1.0, margin: float = 0.04
) -> Camera:
    """Look along the thinnest principal axis of the points, the longest upward.

    Of the two ends of an axis the one with the bulk of the points (against the third moment)
    points upward, or to the eye: bodies stand on their legs, and moving a surface rigidly
    does not change its picture.

    Parameters
    ----------
    points : (N, 3) array
    aspect, margin : float
        As in :func:`camera_on`.
    """
    centred = np.asarray(points, dtype=np.float64) - np.mean(points, axis=0)
    axes = np.linalg.svd(centred, full_matrices=False)[2]
    skewness = ((centred @ axes.T) ** 3).sum(axis=0)
    axes = axes * np.where(skewness > 0, -1.0, 1.0)[:, None]
    return camera_on(points, axes[2], axes[0], aspect, margin)
