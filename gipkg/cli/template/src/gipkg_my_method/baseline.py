"""The baseline my-method: mean powers of the distance from the centre."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import BaselineTags
from gipkg.baselines.vectors import VectorBaseline
from gipkg.descriptors.operators import Operators


class MyMethod(VectorBaseline):
    """Mean powers of the distance from the centre of the surface, which then has area 1."""

    summary: ClassVar[str] = "mean powers of the distance from the centre"
    citation: ClassVar[str] = "Author, Title, Venue, Year"
    # Each tag is a promise, and the checks will hold the baseline to it.
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    order: int = Field(8, ge=1, le=100, description="highest power; the length of the vector")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Average over the surface (see :class:`gipkg.api.Baseline`); (order,)."""
        vertices, weights = np.asarray(mesh.vertices), operators.mass
        centre = np.average(vertices, axis=0, weights=weights)
        distance = np.linalg.norm(vertices - centre, axis=1) / np.sqrt(weights.sum())
        powers = np.arange(1, self.order + 1)
        means: NDArray[np.float64] = np.average(distance[:, None] ** powers, 0, weights)
        return means ** (1 / powers)
