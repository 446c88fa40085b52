"""The modes of a surface of unit area, as signatures of its points sum them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import UnsupportedMesh

if TYPE_CHECKING:
    from gipkg.descriptors.operators import Spectrum

SAME_EIGENVALUE = 1e-8
"""Relative difference up to which eigenvalues are one."""


def modes_at_unit_area(spectrum: Spectrum) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Scale the eigenpairs to unit area, whole eigenspaces only.

    The truncation may cut the last eigenspace in two, and a part of one depends on the basis.

    Returns
    -------
    eigenvalues : (k,) float64 array
        Ascending from 0.
    squares : (V, k) float64 array
        Squared eigenfunctions; their mean over the surface is 1. Summed over an eigenspace,
        they do not depend on its basis.

    Raises
    ------
    UnsupportedMesh
        No eigenspace is known to be whole: there is but one eigenpair.
    """
    last = spectrum.eigenvalues[-1]
    whole = spectrum.eigenvalues < last * (1 - SAME_EIGENVALUE)
    if not whole.any():
        raise UnsupportedMesh("not one of its modes is known for certain: compute more eigenpairs")
    area = spectrum.mass.sum()
    return area * spectrum.eigenvalues[whole], area * spectrum.eigenvectors[:, whole] ** 2


def waves_at_unit_area(spectrum: Spectrum) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what :func:`modes_at_unit_area` does, without the constant mode.

    Raises
    ------
    UnsupportedMesh
        There is no mode, or no other.
    """
    eigenvalues, squares = modes_at_unit_area(spectrum)
    if len(eigenvalues) < 2:
        raise UnsupportedMesh(
            "of its modes only the constant one is known: compute more eigenpairs, or refine it"
        )
    return eigenvalues[1:], squares[:, 1:]
