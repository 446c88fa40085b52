"""Components, cavities and tunnels of a set of voxels."""

from __future__ import annotations

import numpy as np

from gipkg.surfaces.report import VolumeCounts
from gipkg.surfaces.volumes.lattice import Solid, euler_characteristic, label


def count_topology(solid: Solid) -> VolumeCounts:
    """Count the components, cavities and tunnels of a (X, Y, Z) set of voxels.

    Its Euler characteristic is components - tunnels + cavities.
    """
    components = label(solid)[1]
    cavities = label(np.pad(~solid, 1, constant_values=True))[1] - 1
    tunnels = components + cavities - euler_characteristic(solid)
    return VolumeCounts(int(np.count_nonzero(solid)), components, cavities, tunnels)


def largest_component(solid: Solid) -> tuple[Solid, float]:
    """Return the largest component of a non-empty set, and its share of the voxels."""
    labels, _ = label(solid)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    best = int(np.argmax(sizes))
    return labels == best, float(sizes[best] / sizes.sum())


def fill_cavities(solid: Solid) -> Solid:
    """Add to a set, which has no voxel on the array's border, what it encloses."""
    outside, _ = label(~solid)
    return outside != outside[0, 0, 0]
