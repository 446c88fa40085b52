"""Optimal transport: the conformal map, with its density transported to uniform."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags


class OptimalTransport(Parametrizer):
    """Spherical map whose vertices have power cells of the areas they stand for.

    The conformal map carries the areas of the mesh to the sphere as point masses at the vertices.
    Semi-discrete optimal transport from the uniform density to these masses divides the sphere
    into cells of exactly those areas, and every vertex moves to the centroid of its cell. The
    cost -log cos of the distance keeps the sphere's own geometry: cells have great circles for
    sides, and Aleksandrov's theorem gives the solution where no half of the area lies in a point.

    What the cells promise, the faces do not: the mesh is not the diagram's dual triangulation, so
    that faces may flip and their areas differ.
    """

    summary: ClassVar[str] = "cells of exact area about the vertices, by optimal mass transport"
    citation: ClassVar[str] = (
        "Zhao, Su, Gu, Kaufman, Sun, Gao & Luo, Area-preservation mapping using optimal mass "
        "transport, IEEE TVCG 2013; after Dominitz & Tannenbaum, Texture mapping via optimal mass "
        "transport, IEEE TVCG 2010; cost after Oliker, Adv. Math. 2007"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    max_iterations: int = Field(100, ge=1, le=10_000, description="Newton steps at most")
    tolerance: float = Field(
        1e-6, ge=0, lt=1, description="stop when no more of the sphere lies in a wrong cell"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.conformal import Conformal
        from gipkg.parametrizers.transport.transport import transport
        from gipkg.surfaces.areas import at_vertices, face_areas
        from gipkg.surfaces.validation import check_genus_zero

        check_genus_zero(mesh)
        faces = np.asarray(mesh.faces)
        vertices = np.asarray(mesh.vertices, np.float64)
        areas = at_vertices(face_areas(vertices, faces), faces, len(vertices))
        return transport(
            Conformal.model_validate({}).parametrize(mesh),
            areas * (4 * np.pi / areas.sum()),
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            callback=callback,
        )
