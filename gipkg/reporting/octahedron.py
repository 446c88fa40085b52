"""The octahedron that a sphere is unfolded by: its shape, its edges and where it is cut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.images.octahedron import sphere_to_square
from gipkg.images.sampling import Sampling

SOUTH = np.array([0.0, 0.0, -1.0])
"""Where the four edges meet that are cut."""

_POINTS = 65
"""Points that an edge is drawn by."""


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge of the octahedron.

    Attributes
    ----------
    start, end : (3,) float64 array
        Its corners.
    cut : bool
        Whether it begins at the south pole and is opened.
    """

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    cut: bool

    @property
    def chord(self) -> NDArray[np.float64]:
        """Points (N, 3) of the edge on the octahedron."""
        share = np.linspace(0, 1, _POINTS)[:, None]
        return (1 - share) * self.start + share * self.end

    @property
    def arc(self) -> NDArray[np.float64]:
        """Points (N, 3) of the edge on the sphere."""
        return self.chord / np.linalg.norm(self.chord, axis=1, keepdims=True)

    @property
    def on_square(self) -> tuple[NDArray[np.float64], ...]:
        """Ends (2, 2), u and v, of the one or two segments that the edge is on the square.

        A cut edge is on both halves of a side, from the side's middle to its two corners.
        """
        if not self.cut:
            return (np.stack([self.start[:2], self.end[:2]]),)
        middle = self.end[:2]
        along = np.array([-middle[1], middle[0]])
        return tuple(np.stack([middle, middle + way * along]) for way in (1, -1))


def edges() -> tuple[Edge, ...]:
    """Return the twelve edges, the four that are cut first."""
    around = [np.array(place) for place in ([1.0, 0, 0], [0, 1.0, 0], [-1.0, 0, 0], [0, -1.0, 0])]
    cut = [Edge(SOUTH, corner, True) for corner in around]
    upper = [Edge(-SOUTH, corner, False) for corner in around]
    equator = [Edge(around[k - 1], around[k], False) for k in range(4)]
    return (*cut, *upper, *equator)


def sphere_to_octahedron(
    directions: NDArray[np.float64], sampling: Sampling = "equal-area"
) -> NDArray[np.float64]:
    """Move points of the sphere to the octahedron |x| + |y| + |z| = 1, as the image does.

    Parameters
    ----------
    directions : (..., 3) float64 array
        Unit vectors.
    sampling : {"equal-area", "authors"}

    Raises
    ------
    ValueError
        There is no such sampling.
    """
    octant = sphere_to_square(np.abs(directions), sampling)
    height = 1 - octant.sum(axis=-1, keepdims=True)
    return np.copysign(np.concatenate([octant, height], axis=-1), directions)
