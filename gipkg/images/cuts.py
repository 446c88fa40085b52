"""Rotations of the sphere before it is cut and unfolded."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.images.axis import area_centroid, highest_on_axis

TURNS = 6
"""Images per polar axis, 60° apart (paper, section 5)."""

UPRIGHT_TURNS = 12
"""Images of an upright shape, 30° apart (paper, section 5)."""


def standard_cuts() -> Rotation:
    """Return the paper's 36 cuts: six directed polar axes, six turns about each (section 5).

    The axes ±z, ±x, ±y are brought to the north pole in this order, each followed by turns of
    0°, 60°, ... 300° about it; the first cut is the identity.
    """
    half, quarter = np.pi, np.pi / 2
    to_north = Rotation.from_rotvec(
        [
            [0, 0, 0],
            [half, 0, 0],
            [0, -quarter, 0],
            [0, quarter, 0],
            [quarter, 0, 0],
            [-quarter, 0, 0],
        ]
    )
    turns = Rotation.from_rotvec(np.outer(np.arange(TURNS) * 2 * np.pi / TURNS, [0, 0, 1]))
    return Rotation.concatenate([turns * axis for axis in to_north])


def random_cuts(count: int, rng: np.random.Generator) -> Rotation:
    """Draw `count` rotations uniformly."""
    return Rotation.from_quat(rng.standard_normal((count, 4)))


def upright_cuts(
    spherical_map: SphericalMap, turns: int = UPRIGHT_TURNS, azimuth: float = 0.0
) -> Rotation:
    """Return the cuts of a shape whose z axis points up (paper, sections 4.2 and 5).

    The highest point along the vertical axis through the centroid is brought to the north pole.
    About the pole the sphere is first turned to where the points of the surface lie as nearly as
    can be in the azimuth that they have in space, and then to equal steps all around.

    Parameters
    ----------
    spherical_map : SphericalMap
    turns : int
        Number of cuts.
    azimuth : float
        Radians that all of them are turned further. A random one forgets how the shape was posed.

    Returns
    -------
    Rotation
        `turns` of them, 2π / `turns` apart.
    """
    mesh, sphere = spherical_map.mesh, spherical_map.sphere
    centroid, areas = area_centroid(mesh)
    corners, weights = highest_on_axis(mesh, centroid)
    pole = weights @ sphere[corners]
    to_north = _between(pole / np.linalg.norm(pole), np.array([0.0, 0.0, 1.0]))
    turned, offsets = to_north.apply(sphere), np.asarray(mesh.vertices) - centroid
    # Σ area |offset - e^{iα} direction|² over horizontal components as complex numbers is least
    # where α is the argument of Σ area offset · conj(direction).
    misfit = (areas * _horizontal(offsets)) @ _horizontal(turned).conj()
    angles = np.angle(misfit) + azimuth + np.arange(turns) * (2 * np.pi / turns)
    return Rotation.from_rotvec(np.outer(angles, [0, 0, 1])) * to_north


def _between(start: NDArray[np.float64], end: NDArray[np.float64]) -> Rotation:
    """Return the shortest rotation of one unit vector to another; about x between opposites."""
    axis = np.cross(start, end)
    sine, cosine = np.linalg.norm(axis), start @ end
    direction = axis / sine if sine > 0 else np.array([1.0, 0.0, 0.0])
    return Rotation.from_rotvec(direction * np.arctan2(sine, cosine))


def _horizontal(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return np.asarray(points[:, 0] + 1j * points[:, 1])
