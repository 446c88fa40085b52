"""The last word on a map that promises to be bijective."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import ParametrizationError
from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas

_DEGREE = 1e-9
"""Allowed deviation of the degree from 1."""


def require_bijective(sphere: NDArray[np.float64], faces: NDArray[np.int64], way_out: str) -> None:
    """Accept stored coordinates that map a closed mesh to the sphere one to one.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    faces : (F, 3) int64 array
    way_out : str
        Ends the message of the error.

    Raises
    ------
    ParametrizationError
        A face is flipped, decided exactly, or the degree is not 1.
    """
    flips = np.count_nonzero(flipped_faces(sphere, faces))
    degree = signed_spherical_areas(sphere, faces).sum() / (4 * np.pi)
    if flips or not abs(degree - 1) <= _DEGREE:
        raise ParametrizationError(
            f"the map has {flips} flipped faces and degree {degree:.6f}; {way_out}"
        )
