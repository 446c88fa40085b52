"""Global point signature: a point by what every mode of the surface is there."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Descriptor, DescriptorTags
from gipkg.errors import UnsupportedMesh

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class GlobalPointSignature(Descriptor):
    """Modes over the root of their eigenvalues, φ_i(x) / √λ_i, on the surface of unit area.

    Inner products of two points' signatures, all modes taken, are Green's function. A mode is
    known up to its sign only, and the modes of a repeated eigenvalue up to a rotation, which is
    why a symmetric surface has no one signature and the descriptor is not called intrinsic.
    """

    summary: ClassVar[str] = "Global point signature: modes over the root of their eigenvalues"
    citation: ClassVar[str] = (
        "R. M. Rustamov: Laplace-Beltrami Eigenfunctions for Deformation Invariant Shape "
        "Representation. Symposium on Geometry Processing, 2007"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    modes: int = Field(default=5, ge=1, le=100, description="Number of modes, one channel each")
    magnitude: bool = Field(
        True, description="Magnitudes, which do not depend on signs; false gives signed values"
    )

    def channels(self) -> tuple[str, ...]:
        """Names of the channels: the number of each mode, from 1."""
        return tuple(f"gps-{number}" for number in range(1, self.modes + 1))

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Scale the modes of `operators`; (V, C).

        Raises
        ------
        UnsupportedMesh
            There are fewer modes than channels.
        """
        spectrum = operators.spectrum
        known = len(spectrum.eigenvalues) - 1
        if known < self.modes:
            raise UnsupportedMesh(
                f"{self.modes} modes are asked for and {known} are known: "
                "compute more eigenpairs or lower modes"
            )
        kept = slice(1, self.modes + 1)
        # At unit area eigenvalues are times the area, and eigenvectors times its root.
        values = spectrum.eigenvectors[:, kept] / np.sqrt(spectrum.eigenvalues[kept])
        return np.abs(values) if self.magnitude else values
