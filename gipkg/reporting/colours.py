"""Colours of the figures: readable with colour vision deficiencies, and the same everywhere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CATEGORIES = (
    np.array(
        [
            (213, 94, 0),
            (0, 114, 178),
            (0, 158, 115),
            (204, 121, 167),
            (230, 159, 0),
            (86, 180, 233),
            (240, 228, 66),
        ]
    )
    / 255
)
"""Colours of things that have no order: M. Okabe & K. Ito, Color Universal Design, 2008."""

INK = (0.2, 0.2, 0.2)
"""Lines and text."""

CUT = (0.8, 0.05, 0.05)
"""Lines where a sphere is cut."""


SEQUENTIAL = "viridis"
"""Matplotlib's name of the scale from dark to light."""

DIVERGING = "RdBu_r"
"""Matplotlib's name of the scale from -1 (blue) over 0 (white) to 1 (red)."""


def category(number: int) -> NDArray[np.float64]:
    """Return the colour (3,) of one of the things that have no order; they repeat."""
    return CATEGORIES[number % len(CATEGORIES)]


def sequential(values: NDArray[np.floating]) -> NDArray[np.float64]:
    """Colour values from their least to their largest, dark to light: (N,) -> (N, 3)."""
    from matplotlib import colormaps

    low, high = np.min(values), np.max(values)
    return colormaps[SEQUENTIAL]((values - low) / ((high - low) or 1.0))[:, :3]


def diverging(values: NDArray[np.floating], limit: float) -> NDArray[np.float64]:
    """Colour values from -`limit` (blue) over 0 (white) to `limit` (red): (N,) -> (N, 3)."""
    from matplotlib import colormaps

    return colormaps[DIVERGING](0.5 + np.asarray(values) / (2 * limit))[:, :3]


def as_bytes(colours: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Turn colours of any shape from 0 to 1 into bytes; what is beyond is cut off."""
    return np.rint(255 * colours.clip(0, 1)).astype(np.uint8)
