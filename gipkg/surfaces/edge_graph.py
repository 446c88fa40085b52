"""The edges of a mesh as a graph, for distances along the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from gipkg.surfaces.halfedges import endpoints, group_edges


def edge_graph(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> csr_array:
    """Return the symmetric (V, V) graph of the edges of any triangles, with their lengths."""
    edges = group_edges(faces)
    once = edges.order[edges.start]
    origin, target = (ends[once] for ends in endpoints(faces))
    length = np.linalg.norm(vertices[target] - vertices[origin], axis=1)
    both_ways = np.concatenate((origin, target)), np.concatenate((target, origin))
    return csr_array((np.tile(length, 2), both_ways), shape=(len(vertices), len(vertices)))
