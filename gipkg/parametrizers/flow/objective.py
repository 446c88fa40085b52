"""What the flows lower, as their callbacks are told."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.sphere.areas import signed_spherical_areas


def mean_square_distortion(
    sphere: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64]
) -> float:
    """Mean over the mesh of (r - 1)², r being the area of a face on the sphere by its own.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) int64 array
    areas : (F,) float64 array
        Of the faces on the mesh, summing to 4π.
    """
    excess = signed_spherical_areas(sphere, faces) - areas
    return float((excess**2 / areas).sum() / (4 * np.pi))
