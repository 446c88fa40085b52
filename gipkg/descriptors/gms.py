"""Green's mean signature: the modes at a point, weighted by powers of their eigenvalues."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PositiveFloat

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.modes import waves_at_unit_area

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class GreensMeanSignature(Descriptor):
    """Diagonals of powers of Green's function on the surface scaled to unit area.

    g_p(x) = Σ_i λ_i^-p φ_i(x)², i ≥ 1: the heat kernel signature less its mean, averaged over all
    times with the weight t^(p-1) / Γ(p). With p = 1 it is the squared length of the global point
    signature, which only the truncation keeps finite on a surface; above, the sum converges, and
    the larger p, the more global is what it sees.
    """

    summary: ClassVar[str] = "Green's mean signature: diagonals of powers of Green's function"
    citation: ClassVar[str] = (
        "A. Sinha, K. Ramani: Multi-scale Kernels Using Random Walks. Computer Graphics Forum "
        "33(1), 2014"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(
        intrinsic=True, rigid_invariant=True, scale_invariant=True
    )

    moments: tuple[PositiveFloat, ...] = Field(
        default=(1.25, 1.5, 2.0, 3.0), min_length=1, description="Powers p, one channel each"
    )
    logarithm: bool = Field(True, description="Logarithm of the signature; false gives it raw")

    def channels(self) -> tuple[str, ...]:
        """Names of the channels: what is in it, and its power."""
        prefix = "log-gms" if self.logarithm else "gms"
        return tuple(f"{prefix}-{moment:.4g}" for moment in self.moments)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Sum the eigenpairs of `operators`; (V, C).

        Raises
        ------
        UnsupportedMesh
            Only the constant mode is known.
        """
        eigenvalues, squares = waves_at_unit_area(operators.spectrum)
        signature = squares @ eigenvalues[:, None] ** -np.array(self.moments)
        return np.log(signature) if self.logarithm else signature
