"""What a face pays for its area ratio r, sphere over mesh.

A face that is too small pays (log r)², infinite when it collapses; one that is too large pays
r + 1/r - 2, about what it takes from the others. Both are the same to third order at r = 1. The
squared logarithm alone would grow so slowly that a single face may keep hundreds of its shares.
"""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled


@compiled
def area_penalty(ratio: float) -> float:
    """Evaluate the penalty."""
    if ratio < 1:
        return np.log(ratio) ** 2
    return ratio + 1 / ratio - 2


@compiled
def area_penalty_derivatives(ratio: float) -> tuple[float, float]:
    """Evaluate its slope and its Gauss-Newton curvature, that of a square of its root."""
    if ratio < 1:
        return 2 * np.log(ratio) / ratio, 2 / ratio**2
    return 1 - 1 / ratio**2, 0.5 * (1 + 1 / ratio) ** 2 / ratio
