"""Rotations of the sphere before it is cut and unfolded."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

TURNS = 6
"""Images per polar axis, 60° apart (paper, section 5)."""


def standard_cuts() -> Rotation:
    """Return the paper's 36 cuts: six directed polar axes, six turns about each (section 5).

    The axes ±z, ±x, ±y are brought to the north pole in this order, each followed by turns of
    0°, 60°, ... 300° about it; the first cut is the identity.
    """
    half, quarter = np.pi, np.pi / 2
    to_north = Rotation.from_rotvec(
        [
            [0, 0, 0],
            [half, 0, 0],
            [0, -quarter, 0],
            [0, quarter, 0],
            [quarter, 0, 0],
            [-quarter, 0, 0],
        ]
    )
    turns = Rotation.from_rotvec(np.outer(np.arange(TURNS) * 2 * np.pi / TURNS, [0, 0, 1]))
    return Rotation.concatenate([turns * axis for axis in to_north])


def random_cuts(count: int, rng: np.random.Generator) -> Rotation:
    """Draw `count` rotations uniformly."""
    return Rotation.from_quat(rng.standard_normal((count, 4)))
