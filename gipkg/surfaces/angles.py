"""Angles of faces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def corner_cotangents(
    vertices: NDArray[np.float64], faces: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return the cotangents (F, 3) of the angles at the faces' corners."""
    corners = vertices[faces]
    to_next = np.roll(corners, -1, axis=1) - corners
    to_previous = np.roll(corners, 1, axis=1) - corners
    doubled = np.linalg.norm(np.cross(to_next, to_previous), axis=2)
    cotangents: NDArray[np.float64] = np.einsum("fkc,fkc->fk", to_next, to_previous) / doubled
    return cotangents
