"""Descriptors: from a mesh to channels at its vertices."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api.plugin import Plugin

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


@dataclass(frozen=True, slots=True)
class DescriptorTags:
    """How a descriptor behaves under changes of the surface."""

    intrinsic: bool = False
    """Unchanged by isometries, articulation included."""
    rigid_invariant: bool = False
    """Unchanged by rotations and translations."""
    scale_invariant: bool = False


class Descriptor(Plugin):
    """Mesh to per-vertex channels."""

    tags: ClassVar[DescriptorTags] = DescriptorTags()

    @abstractmethod
    def channels(self) -> tuple[str, ...]:
        """Names of the C channels, in order."""

    @abstractmethod
    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Compute the channels at every vertex.

        Parameters
        ----------
        mesh : trimesh.Trimesh
            V vertices; never changed.
        operators : Operators
            Laplacian, mass and eigenpairs of `mesh`, computed at first use and shared, and its
            topological mask.

        Returns
        -------
        (V, C) float64 array
        """
