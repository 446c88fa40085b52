"""The area distortion of a map, seen as a histogram over its triangles (paper, Figure 7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.evaluation.distortion import Distortion

BINS = 101
LIMIT = 2.0


def bin_edges() -> NDArray[np.float64]:
    """Return the BINS + 1 edges of the bins, which are equally wide; 0 is in the middle of one."""
    return np.linspace(-LIMIT, LIMIT, BINS + 1)


def area_histogram(distortion: Distortion) -> NDArray[np.int64]:
    """Count the triangles by their area distortion.

    The distortion is the paper's δh·A, sphere area minus mesh area where both sum to 4π, here in
    units of the mean triangle's area 4π/F: shapes of any resolution go into one histogram.

    Returns
    -------
    (BINS,) int64 array
        Triangles in each bin of :func:`bin_edges`; the first and the last one also count
        everything beyond.
    """
    areas = distortion.mesh_areas
    excess = (distortion.spherical_areas - areas) / areas.mean()
    counts, _ = np.histogram(excess.clip(-LIMIT, LIMIT), bin_edges())
    return counts
