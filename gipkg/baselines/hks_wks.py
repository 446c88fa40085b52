"""How heat and wave kernel signatures are distributed over a surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import BaselineTags
from gipkg.baselines.vectors import VectorBaseline
from gipkg.descriptors.hks import HeatKernelSignature
from gipkg.descriptors.wks import WaveKernelSignature

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class SignatureQuantiles(VectorBaseline):
    """Quantiles over the surface of every channel of the two signatures.

    Not in the paper: what the channels of a geometry image tell without the image.
    """

    summary: ClassVar[str] = "Quantiles of heat and wave kernel signatures over the surface"
    citation: ClassVar[str] = (
        "J. Sun, M. Ovsjanikov, L. Guibas: A Concise and Provably Informative Multi-Scale "
        "Signature Based on Heat Diffusion. SGP, 2009; M. Aubry, U. Schlickewei, D. Cremers: The "
        "Wave Kernel Signature. ICCV Workshops, 2011"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    times: int = Field(10, ge=1, le=100, description="Number of times of the heat kernel")
    energies: int = Field(16, ge=1, le=100, description="Number of energies of the wave kernel")
    levels: int = Field(
        9, ge=1, le=99, description="Number of quantiles a channel: 1/(2n), 3/(2n), …, 1 - 1/(2n)"
    )

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Sort the signatures by value, weighted by area; ((times + energies) * levels,)."""
        descriptors = (
            HeatKernelSignature(times=self.times),
            WaveKernelSignature(energies=self.energies),
        )
        channels = np.hstack([one.describe(mesh, operators) for one in descriptors])
        levels = (np.arange(self.levels) + 0.5) / self.levels
        return weighted_quantiles(channels, operators.mass, levels).ravel()


def weighted_quantiles(
    channels: NDArray[np.float64], weights: NDArray[np.float64], levels: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Take quantiles of (V, C) channels whose rows have weights; (C, L).

    A value stands at the middle of its weight on the cumulative scale, and between two values
    the quantile is linear.
    """
    order = channels.argsort(axis=0)
    ranked = np.take_along_axis(channels, order, axis=0)
    share = weights[order] / weights.sum()
    places = share.cumsum(axis=0) - share / 2
    return np.stack([np.interp(levels, *pair) for pair in zip(places.T, ranked.T, strict=True)])
