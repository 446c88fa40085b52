"""Which way a surface faces at its vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def vertex_normals(
    vertices: NDArray[np.float64], faces: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Average the normals of the faces around each vertex by their areas.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
        Counter-clockwise as seen from outside.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, outwards; +z where the faces around a vertex cancel out.
    """
    corners = vertices[faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.stack(
        [np.bincount(faces.ravel(), np.repeat(axis, 3), len(vertices)) for axis in areas.T], axis=1
    )
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    upwards = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    return np.divide(sums, lengths, out=upwards, where=lengths > 0)
