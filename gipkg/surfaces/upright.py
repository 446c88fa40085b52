"""Shapes that stand upright, turned so that z is up."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.api.dataset import Axis

_CYCLES: dict[Axis, list[int]] = {"x": [1, 2, 0], "y": [2, 0, 1], "z": [0, 1, 2]}
"""Which coordinate becomes x, y and z. A cycle is a rotation: left stays left."""


def with_z_up(points: NDArray[np.float64], up: Axis) -> NDArray[np.float64]:
    """Turn (V, 3) points so that the axis `up` becomes the z axis."""
    return points[:, _CYCLES[up]]
