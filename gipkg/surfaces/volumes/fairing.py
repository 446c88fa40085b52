"""Smoothing that takes the steps of the voxels away and leaves the size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from gipkg.surfaces.halfedges import endpoints

FORWARD, BACKWARD = 0.5, -0.53
"""Steps of the low-pass filter: pass band up to 1 / FORWARD + 1 / BACKWARD = 0.11."""


def fair(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], rounds: int
) -> NDArray[np.float64]:
    """Move vertices to and from their neighbours' mean: a low-pass filter without shrinking.

    Source: G. Taubin, A Signal Processing Approach to Fair Surface Design, SIGGRAPH 1995.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
        Closed.
    rounds : int
        Pairs of a step forward and a step back.

    Returns
    -------
    (V, 3) array
    """
    origin, target = endpoints(faces)
    size = len(vertices)
    adjacency = csr_array((np.ones(len(origin)), (origin, target)), shape=(size, size))
    inverse_degree = 1 / adjacency.sum(axis=1)[:, None]
    for _ in range(rounds):
        for step in (FORWARD, BACKWARD):
            vertices = vertices + step * (inverse_degree * (adjacency @ vertices) - vertices)
    return vertices
