"""What an area ratio r, sphere over mesh, leaves to be desired; faces pay its square.

A face that is too small has log r, which is infinite when it collapses; one that is too large has
√r - 1/√r, whose square r + 1/r - 2 is about what it takes from the others. Both agree to second
order at r = 1. The logarithm alone would grow so slowly that a single face may keep hundreds of
its shares.
"""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled


@compiled
def area_residual(ratio: float) -> tuple[float, float]:
    """Evaluate the residual and its slope."""
    if ratio < 1:
        return np.log(ratio), 1 / ratio
    root = np.sqrt(ratio)
    return (ratio - 1) / root, 0.5 * (1 + 1 / ratio) / root
