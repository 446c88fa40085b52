"""Which part of a surface is the original one, and which was added to make its genus 0."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.position import CITATION

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class TopologicalMask(Descriptor):
    """1 on the original surface, 0 on the caps, membranes and strands that closed it.

    The holes that a surface of genus 0 has lost are seen again in this channel (paper, section
    3). The surface stage knows them (:attr:`gipkg.surfaces.Surface.mask`).
    """

    summary: ClassVar[str] = "1 on the original surface, 0 on what closed its holes"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(
        intrinsic=True, rigid_invariant=True, scale_invariant=True
    )

    def channels(self) -> tuple[str, ...]:
        """Name of the channel."""
        return ("topological-mask",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Pass the mask on; (V, 1)."""
        return operators.mask[:, None].astype(np.float64)
