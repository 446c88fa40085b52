"""The stars of all vertices of a closed mesh, in flat arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces.edge_collapse import gather_ring
from gipkg.surfaces.halfedges import twins


@dataclass(frozen=True, slots=True)
class Stars:
    """Neighbours and faces around every vertex, counterclockwise.

    Attributes
    ----------
    offsets : (V + 1,) int64 array
        Star v has the entries ``offsets[v]:offsets[v + 1]`` of the other two arrays.
    ring : (3F,) int64 array
        Neighbours.
    corners : (3F,) int64 array
        Corner ``3 f + k`` that face f has at the vertex; its other corners are this neighbour
        and the next.
    """

    offsets: NDArray[np.int64]
    ring: NDArray[np.int64]
    corners: NDArray[np.int64]

    @classmethod
    def of(cls, faces: NDArray[np.int64]) -> Stars:
        """Gather the stars of a closed oriented manifold mesh with faces (F, 3)."""
        return cls(*_gather(twins(faces), np.ascontiguousarray(faces).ravel()))


@compiled
def _gather(twin, origin):  # type: ignore[no-untyped-def]
    count = origin.max() + 1
    outgoing = np.zeros(count, np.int64)
    offsets = np.zeros(count + 1, np.int64)
    for h in range(len(origin)):
        outgoing[origin[h]] = h
        offsets[origin[h] + 1] += 1
    offsets = np.cumsum(offsets)
    ring, corners = np.zeros(len(origin), np.int64), np.zeros(len(origin), np.int64)
    for v in range(count):
        gather_ring(twin, origin, outgoing[v], ring[offsets[v] :], corners[offsets[v] :])
    return offsets, ring, corners
