"""What keeps arrays from being a triangle mesh, whoever made them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def array_fault(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> str | None:
    """Name what keeps the arrays from describing any triangle mesh, or return None."""
    if not len(faces):
        return "it has no faces"
    if not np.isfinite(vertices).all():
        return f"{np.count_nonzero(~np.isfinite(vertices).all(axis=1))} vertices are not finite"
    outside = ((faces < 0) | (faces >= len(vertices))).any(axis=1)
    if outside.any():
        return f"{np.count_nonzero(outside)} faces name a vertex that does not exist"
    return None
