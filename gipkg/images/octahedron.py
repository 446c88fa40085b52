"""Sphere to octahedron to square, and back.

The octahedron |x| + |y| + |z| = 1 is cut along the four edges that meet at its south pole and
unfolded to the square [-1, 1]²: the north pole is the centre, the equator the diamond
|u| + |v| = 1, the south pole all four corners, and each side of the square is one cut edge,
folded at its midpoint. With u to the right and v up, the square shows the sphere from outside.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gipkg.images.sampling import SAMPLINGS, Sampling


def sphere_to_square(
    directions: ArrayLike, sampling: Sampling = "equal-area"
) -> NDArray[np.float64]:
    """Lay points of the unit sphere on the square.

    A point of the cut has two images; one of them is returned.

    Parameters
    ----------
    directions : (..., 3) array_like
        Unit vectors.
    sampling : {"equal-area", "authors"}

    Returns
    -------
    (..., 2) float64 array
        u and v in [-1, 1].

    Raises
    ------
    ValueError
        There is no such sampling.
    """
    directions = np.asarray(directions, dtype=np.float64)
    folded = np.abs(directions)
    u, v = _octant_to_triangle(folded, sampling)
    south = directions[..., 2] < 0
    u, v = np.where(south, 1 - v, u), np.where(south, 1 - u, v)
    return np.stack(
        [np.copysign(u, directions[..., 0]), np.copysign(v, directions[..., 1])], axis=-1
    )


def square_to_sphere(points: ArrayLike, sampling: Sampling = "equal-area") -> NDArray[np.float64]:
    """Wrap the square around the unit sphere; the inverse of :func:`sphere_to_square`.

    Points of the border that the cut identifies get bit-equal directions.

    Parameters
    ----------
    points : (..., 2) array_like
        u and v in [-1, 1].
    sampling : {"equal-area", "authors"}

    Returns
    -------
    (..., 3) float64 array
        Unit vectors.

    Raises
    ------
    ValueError
        There is no such sampling.
    """
    points = np.asarray(points, dtype=np.float64)
    u, v = np.abs(points[..., 0]), np.abs(points[..., 1])
    south = u + v > 1
    u, v = np.where(south, 1 - v, u), np.where(south, 1 - u, v)
    x, y, z = _triangle_to_octant(u, v, sampling)
    # Where x or y is 0 its sign is that of an arbitrary side of the cut: add 0.0 to drop it.
    return np.stack(
        [
            np.copysign(x, points[..., 0]) + 0.0,
            np.copysign(y, points[..., 1]) + 0.0,
            np.where(south, -z, z) + 0.0,
        ],
        axis=-1,
    )


def pixel_directions(size: int, sampling: Sampling = "equal-area") -> NDArray[np.float64]:
    """Directions (size, size, 3) of the pixels of an image.

    Pixels sit on the vertices of a grid whose border is the cut, so that a border pixel and
    its mirror image about the middle of its side are one point of the sphere. Columns run
    with u, rows against v: an image drawn with row 0 on top is seen from outside.

    Raises
    ------
    ValueError
        There is no such sampling.
    """
    # Odd integers over an integer: exactly antisymmetric about 0, unlike a linspace.
    axis = (2 * np.arange(size) - (size - 1)) / (size - 1)
    u, v = np.meshgrid(axis, -axis)
    return square_to_sphere(np.stack([u, v], axis=-1), sampling)


def _octant_to_triangle(
    octant: NDArray[np.float64], sampling: Sampling
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Map x, y, z ≥ 0 on the sphere to u, v ≥ 0 with u + v ≤ 1; the pole to the origin."""
    x, y, z = np.moveaxis(octant, -1, 0)
    if _checked(sampling) == "authors":
        half = np.pi / 4  # half the octant's area, as the arctangents are of the parts'
        return np.arctan2(x, 1 + y + z) / half, np.arctan2(y, 1 + z + x) / half
    # The cap above z covers 1 - z of the octant, the triangle below r covers r² of its half
    # square; within both, area is proportional to the azimuth and to v / r.
    rho = np.hypot(x, y)
    r = rho / np.sqrt(1 + z)  # = √(1 - z), without the cancellation near the pole
    v = r * np.arctan2(y, x) * (2 / np.pi)
    return r - v, v


def _triangle_to_octant(
    u: NDArray[np.float64], v: NDArray[np.float64], sampling: Sampling
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Inverse of :func:`_octant_to_triangle`."""
    if _checked(sampling) == "authors":
        # A sub-triangle's area E has tan(E/2) = x / (1 + y + z), and so on in turn: linear in
        # x, y, z up to their common scale.
        tangents = np.tan(np.stack([u, v, np.maximum(1 - u - v, 0)]) * (np.pi / 4))
        octant = tangents / (1 + tangents)
        x, y, z = octant / np.linalg.norm(octant, axis=0)
        return x, y, z
    r = u + v
    azimuth = np.divide(v, r, out=np.zeros_like(r), where=r > 0) * (np.pi / 2)
    rho = r * np.sqrt(np.maximum(2 - r * r, 0))
    # Each of the two is taken by the function that is exactly 0 on its side of the octant.
    from_y = np.divide(u, r, out=np.zeros_like(r), where=r > 0) * (np.pi / 2)
    return rho * np.sin(from_y), rho * np.sin(azimuth), 1 - r * r


def _checked(sampling: Sampling) -> Sampling:
    if sampling not in SAMPLINGS:
        raise ValueError(f"sampling is {sampling!r}, not one of {', '.join(SAMPLINGS)}")
    return sampling
