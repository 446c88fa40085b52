"""The parametrizer my-method: radial projection, the simplest map to the sphere."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags
from gipkg.surfaces.validation import check_genus_zero


class MyMethod(Parametrizer):
    """Radial projection from a centre; bijective only where every point is seen from it."""

    summary: ClassVar[str] = "radial projection from the centre"
    citation: ClassVar[str] = "Author, Title, Venue, Year"
    # Promise "bijective", "area" or "angle" here, and the checks will hold the method to it.
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(guarantees=frozenset())

    centre: Literal["surface", "vertices"] = Field(
        "surface", description="mean of the surface, or of the vertices"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Project the vertices (see :class:`gipkg.api.Parametrizer`)."""
        check_genus_zero(mesh)
        vertices = np.asarray(mesh.vertices)
        centre = mesh.centroid if self.centre == "surface" else vertices.mean(axis=0)
        direction: NDArray[np.float64] = vertices - centre
        return direction / np.linalg.norm(direction, axis=1, keepdims=True)
