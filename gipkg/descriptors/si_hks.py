"""Scale-invariant heat kernel signature: what is left of heat when local scale is forgotten."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.modes import modes_at_unit_area

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class ScaleInvariantHKS(Descriptor):
    """Lowest Fourier magnitudes of the logarithmic heat kernel signature's slope.

    Scaling a surface by β shifts its signature along the logarithm of time, by 2 log β, and
    divides it by β². The differences of log h between successive times lose the factor, and the
    magnitudes of their discrete Fourier transform lose the shift as far as no slope is left at
    either end of the times. For that the original starts so early that no mode of the truncated
    sum has decayed yet (here 2^-14, with 18 octaves). What it sees there is the truncation and
    the mesh, so that the default starts where a coarse mesh still carries heat; parts of a
    surface are then compared over scales within limits.
    """

    summary: ClassVar[str] = "Scale-invariant heat kernel signature"
    citation: ClassVar[str] = (
        "M. Bronstein, I. Kokkinos: Scale-invariant heat kernel signatures for non-rigid shape "
        "recognition. CVPR, 2010"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(
        intrinsic=True, rigid_invariant=True, scale_invariant=True
    )

    frequencies: int = Field(
        default=6, ge=1, le=32, description="Number of lowest frequencies, one channel each"
    )
    steps_per_octave: int = Field(
        default=16, ge=2, le=64, description="Times for each doubling of the time"
    )
    shortest: float = Field(
        default=2.0**-7,
        gt=0,
        description="First time, in units of the surface area (of 1 / eigenvalue)",
    )
    octaves: int = Field(
        default=10, ge=4, le=64, description="How often the time doubles until the last"
    )

    @model_validator(mode="after")
    def _enough_times(self) -> Self:
        if 2 * (self.frequencies - 1) > self.octaves * self.steps_per_octave:
            raise ValueError(
                f"{self.octaves} octaves of {self.steps_per_octave} steps have fewer than "
                f"{self.frequencies} frequencies"
            )
        return self

    def schedule(self) -> NDArray[np.float64]:
        """Return the times, ascending, in units of the surface area."""
        steps = np.arange(self.octaves * self.steps_per_octave + 1)
        return self.shortest * 2.0 ** (steps / self.steps_per_octave)

    def channels(self) -> tuple[str, ...]:
        """Names of the channels: the frequency of each, in cycles over the whole range."""
        return tuple(f"si-hks-{frequency}" for frequency in range(self.frequencies))

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Transform the signature of `operators`; (V, C), not negative."""
        eigenvalues, squares = modes_at_unit_area(operators.spectrum)
        signature = squares @ np.exp(-np.outer(eigenvalues, self.schedule()))
        slopes = np.diff(np.log(signature), axis=1)
        cycles = np.outer(np.arange(slopes.shape[1]), np.arange(self.frequencies))
        return np.abs(slopes @ np.exp(-2j * np.pi * cycles / slopes.shape[1]))
