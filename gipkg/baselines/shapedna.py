"""ShapeDNA: the lower end of the Laplace spectrum as a fingerprint of the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import BaselineTags
from gipkg.baselines.vectors import VectorBaseline
from gipkg.errors import UnsupportedMesh

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators

ROUND_OFF = 1e-9
"""A second eigenvalue times the area that is no larger stands for a second component."""


class ShapeDNA(VectorBaseline):
    """Logarithms of the first eigenvalues times the surface area, the zero one left out.

    Not in the paper; the honest bar, since it needs neither a map nor a network.
    """

    summary: ClassVar[str] = "Logarithms of the first Laplace eigenvalues, scaled by the area"
    citation: ClassVar[str] = (
        "M. Reuter, F.-E. Wolter, N. Peinecke: Laplace-Beltrami spectra as 'Shape-DNA' of "
        "surfaces and solids. Computer-Aided Design 38(4), 2006"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    eigenvalues: int = Field(30, ge=1, le=1000, description="Number of positive eigenvalues")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Take the eigenvalues from `operators`; (eigenvalues,), ascending.

        Raises
        ------
        UnsupportedMesh
            The operators have fewer eigenvalues, or the surface is not connected.
        """
        spectrum = operators.spectrum
        values = spectrum.eigenvalues[1 : self.eigenvalues + 1] * spectrum.mass.sum()
        if len(values) < self.eigenvalues:
            raise UnsupportedMesh(
                f"{len(spectrum.eigenvalues)} eigenpairs are too few for {self.eigenvalues} "
                "positive eigenvalues: compute more, or refine the mesh"
            )
        if values[0] <= ROUND_OFF:
            raise UnsupportedMesh("the surface is not connected: its second eigenvalue is 0")
        return np.log(values)
