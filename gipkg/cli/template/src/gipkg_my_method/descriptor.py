"""The descriptor my-method: powers of the distance from the centre."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.operators import Operators


class MyMethod(Descriptor):
    """Powers of the distance from the centre of the surface, which then has area 1."""

    summary: ClassVar[str] = "powers of the distance from the centre"
    citation: ClassVar[str] = "Author, Title, Venue, Year"
    # Each tag is a promise, and the checks will hold the descriptor to it.
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    powers: int = Field(2, ge=1, le=10, description="number of powers, one channel each")

    def channels(self) -> tuple[str, ...]:
        """Return a name for each power."""
        return tuple(f"distance-{power}" for power in self._exponents())

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Measure the distances of the vertices (see :class:`gipkg.api.Descriptor`)."""
        vertices = np.asarray(mesh.vertices)
        centre = np.average(vertices, axis=0, weights=operators.mass)
        distance = np.linalg.norm(vertices - centre, axis=1) / np.sqrt(operators.mass.sum())
        channels: NDArray[np.float64] = distance[:, None] ** self._exponents()
        return channels

    def _exponents(self) -> NDArray[np.int64]:
        return np.arange(1, self.powers + 1)
