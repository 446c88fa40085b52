"""The Freudenthal lattice: every cube of voxels cut into six tetrahedra along its diagonal.

A voxel has 14 neighbours in it, the same for solid and background, and the tetrahedra around
a voxel end in a triangulated sphere, its link. That makes digital topology exact: a set of
voxels has the topology of the tetrahedra that it spans, the background has that of the
complement, and marching tetrahedra put the surface in between (H. Freudenthal, Simplizial-
zerlegungen von beschränkter Flachheit, Annals of Mathematics 43, 1942).
"""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Solid = NDArray[np.bool_]

CORNERS = np.array([[corner >> axis & 1 for axis in range(3)] for corner in range(8)])
"""The (8, 3) corners of a cube; the bits of a corner's number are its coordinates."""

NEIGHBOURS = np.concatenate((CORNERS[1:], -CORNERS[1:]))
"""The (14, 3) steps to the neighbours of a voxel."""


def _structure() -> Solid:
    structure = np.zeros((3, 3, 3), bool)
    structure[tuple(NEIGHBOURS.T + 1)] = True
    structure[1, 1, 1] = True
    return structure


STRUCTURE = _structure()
"""The neighbourhood in the form that `scipy.ndimage` takes."""


def label(solid: Solid) -> tuple[NDArray[np.int32], int]:
    """Label the components of a (X, Y, Z) set of voxels from 1, and count them."""
    labels, count = ndimage.label(solid, STRUCTURE)
    return labels, int(count)


@cache
def simple_links() -> Solid:
    """Tell of every neighbourhood whether its voxel is simple.

    A voxel is simple when its being solid or not changes no topology. In this lattice that is
    so exactly when its solid neighbours span a connected, non-empty part of its link and so
    do the others: a part of a sphere is contractible when it and its complement are connected
    (Alexander duality).

    Returns
    -------
    (2¹⁴,) bool array
        Bit k of the index: neighbour k is solid.
    """
    everything = (1 << len(NEIGHBOURS)) - 1
    links = np.arange(everything + 1)
    simple = _is_connected(links) & _is_connected(links ^ everything)
    simple.flags.writeable = False
    return simple


def _is_connected(sets: NDArray[np.int64]) -> Solid:
    """Tell which sets of neighbours, as bits, are connected and not empty."""
    steps = {tuple(step) for step in NEIGHBOURS.tolist()}
    beside = [
        sum(1 << k for k, other in enumerate(NEIGHBOURS) if tuple((other - one).tolist()) in steps)
        for one in NEIGHBOURS
    ]
    grown = sets & -sets
    while True:
        before = grown.copy()
        for k, bits in enumerate(beside):
            grown |= np.where(before >> k & 1, bits, 0) & sets
        if np.array_equal(grown, before):
            return (sets != 0) & (grown == sets)


def euler_characteristic(solid: Solid) -> int:
    """Return voxels - edges + triangles - tetrahedra of what a set of voxels spans."""
    padded = np.pad(solid, 1)
    inside = [padded[tuple(slice(c, c - 1 or None) for c in corner)] for corner in CORNERS]
    chi = int(np.count_nonzero(solid))
    for a in range(1, 8):
        edge = inside[0] & inside[a]
        chi -= int(np.count_nonzero(edge))
        for b in range(a + 1, 8):
            if a & b == a:
                chi += int(np.count_nonzero(edge & inside[b]))
    for one, two in combinations(range(3), 2):
        both = inside[0] & inside[1 << one | 1 << two] & inside[7]
        chi -= int(np.count_nonzero(both & inside[1 << one]))
        chi -= int(np.count_nonzero(both & inside[1 << two]))
    return chi
