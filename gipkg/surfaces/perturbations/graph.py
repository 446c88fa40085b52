"""The edges of a mesh as a graph, for distances along the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from gipkg.surfaces.halfedges import endpoints


def edge_graph(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> csr_array:
    """Return the (V, V) graph of the edges of a closed surface, with their lengths."""
    origin, target = endpoints(faces)
    length = np.linalg.norm(vertices[target] - vertices[origin], axis=1)
    return csr_array((length, (origin, target)), shape=(len(vertices), len(vertices)))
