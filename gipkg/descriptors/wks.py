"""Wave kernel signature: how likely a quantum particle of some energy is found at a point."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.modes import waves_at_unit_area

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class WaveKernelSignature(Descriptor):
    """Mean squared modes around an energy, on the surface scaled to unit area.

    w_e(x) = Σ_i c_i(e) φ_i(x)² with c_i(e) ∝ exp(-(e - log λ_i)² / 2σ²) and Σ_i c_i(e) = 1.
    Where the heat kernel is a low-pass filter, this is a band-pass filter. Energies are given
    as eigenvalues in units of 1 / area, the same for every surface; the original takes them
    between the first and the last eigenvalue of each surface.
    """

    summary: ClassVar[str] = "Wave kernel signature at logarithmically spaced energies"
    citation: ClassVar[str] = (
        "M. Aubry, U. Schlickewei, D. Cremers: The Wave Kernel Signature: A Quantum Mechanical "
        "Approach to Shape Analysis. ICCV Workshops, 2011"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(
        intrinsic=True, rigid_invariant=True, scale_invariant=True
    )

    energies: int = Field(
        default=16, ge=1, le=100, description="Number of energies, one channel each"
    )
    # By Weyl's law about λ / 4π modes lie below λ: 120 eigenpairs end near 1,500, and half the
    # width of a band, on the logarithmic scale, has to fit below that.
    lowest: float = Field(
        default=8.0, gt=0, description="First energy, as an eigenvalue in units of 1 / area"
    )
    highest: float = Field(
        default=500.0,
        gt=0,
        description="Last energy, likewise; the energies between are logarithmic",
    )
    width: float = Field(
        default=0.3,
        ge=0.01,
        le=10,
        description="Standard deviation σ of the logarithm of the energy",
    )

    @model_validator(mode="after")
    def _ascending(self) -> Self:
        if self.lowest > self.highest:
            raise ValueError(f"lowest energy {self.lowest} exceeds highest {self.highest}")
        return self

    def schedule(self) -> NDArray[np.float64]:
        """Return the energies (C,), ascending, as eigenvalues in units of 1 / area."""
        return np.geomspace(self.lowest, self.highest, self.energies)

    def channels(self) -> tuple[str, ...]:
        """Names of the channels: the energy of each."""
        return tuple(f"wks-{energy:.4g}" for energy in self.schedule())

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Sum the eigenpairs of `operators`; (V, C), not negative, with mean 1 on the surface.

        Raises
        ------
        UnsupportedMesh
            Only the constant mode is known.
        """
        eigenvalues, squares = waves_at_unit_area(operators.spectrum)
        offsets = np.log(eigenvalues[:, None]) - np.log(self.schedule())
        exponents = -((offsets / self.width) ** 2) / 2
        # Relative to the nearest mode, or an energy far from all of them would underflow.
        weights = np.exp(exponents - exponents.max(axis=0))
        return squares @ (weights / weights.sum(axis=0))
