"""Areas of faces, and what faces hold shared among their corners."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def face_areas(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.float64]:
    """Return the (F,) areas of the faces."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    area: NDArray[np.float64] = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return area


def at_vertices(
    per_face: NDArray[np.float64], faces: NDArray[np.integer], count: int
) -> NDArray[np.float64]:
    """Share what every face holds, such as its area, equally among its three corners.

    Parameters
    ----------
    per_face : (F,) float64 array
    faces : (F, 3) integer array
    count : int
        Number of vertices V.

    Returns
    -------
    (V,) float64 array
        A third of the faces around each vertex; 0 where there is none.
    """
    return np.bincount(faces.ravel(), np.repeat(per_face / 3, 3), count).astype(np.float64)
