"""A set of voxels of genus 0 around any solid: its bounding box, shrunk without tearing."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from gipkg.compilation import compiled
from gipkg.surfaces.volumes.lattice import NEIGHBOURS, Solid, simple_links


def contractible_hull(solid: Solid) -> Solid:
    """Shrink the box of a solid around it by simple voxels, those farthest from it first.

    A box is contractible and stays so while only simple voxels leave it. What cannot leave
    fills the cavities, closes each tunnel by a membrane one voxel thick, and joins parts by
    strands. The order places them: the box recedes like a sinking water level from all sides
    at once, so a membrane is left at the narrowest place of its tunnel and a strand where two
    parts come closest (homotopic thinning by a priority: G. Bertrand, G. Malandain, A new
    characterization of three-dimensional simple points, Pattern Recognition Letters 15, 1994;
    the order after P. Soille, Morphological Image Analysis, 2003, on flooding).

    Parameters
    ----------
    solid : (X, Y, Z) bool array
        Not empty, and without a solid voxel on the array's border.

    Returns
    -------
    (X, Y, Z) bool array
        Contractible: connected, without cavities and without tunnels. It contains `solid`.
    """
    box = ndimage.find_objects(solid.view(np.uint8))[0]
    hull = np.zeros_like(solid)
    hull[box] = True
    order = np.full(solid.shape, -1, np.int32)
    # Squared distances between voxels are integers: each is a rank of the queue.
    order[box] = np.rint(ndimage.distance_transform_edt(~solid[box]) ** 2)
    order[solid] = -1
    strides = np.array([solid.shape[1] * solid.shape[2], solid.shape[2], 1])
    _shrink(hull.reshape(-1), order.reshape(-1), NEIGHBOURS @ strides, simple_links())
    return hull


@compiled
def _shrink(hull, order, neighbours, simple):  # type: ignore[no-untyped-def]
    """Remove simple voxels of an order of at least 0, the highest first, then first come."""
    first = np.full(order.max() + 1, -1, np.int64)
    last = np.full(len(first), -1, np.int64)
    following = np.full(len(hull), -1, np.int64)
    queued = np.zeros(len(hull), np.bool_)
    current = len(first) - 1
    for voxel in range(len(hull)):
        if order[voxel] >= 0:
            _append(voxel, order[voxel], first, last, following, queued)
    while current >= 0:
        voxel = first[current]
        if voxel < 0:
            current -= 1
            continue
        first[current] = following[voxel]
        following[voxel] = -1
        queued[voxel] = False
        link = 0
        for k, step in enumerate(neighbours):
            link |= hull[voxel + step] << k
        if not simple[link]:
            continue
        hull[voxel] = False
        for step in neighbours:
            other = voxel + step
            if hull[other] and order[other] >= 0 and not queued[other]:
                _append(other, order[other], first, last, following, queued)
                current = max(current, order[other])


@compiled
def _append(voxel, rank, first, last, following, queued):  # type: ignore[no-untyped-def]
    """Put a voxel at the end of the queue of its rank."""
    if first[rank] < 0:
        first[rank] = voxel
    else:
        following[last[rank]] = voxel
    last[rank] = voxel
    queued[voxel] = True
