"""The penalty method: unconstrained energies of projected triangles, large ones penalised."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags


class Penalty(Parametrizer):
    """Spherical map that minimises an area-penalised energy of its triangles.

    The energy mixes Dirichlet energy with squared area ratios, each bounded from above for the
    spherical triangle by that of the flat one over its distance from the centre. Vertices are
    normalised inside the energy, so that no constraint is needed. The degree stays 1; faces may
    flip, since the energy knows areas without their sign.
    """

    summary: ClassVar[str] = "large triangles penalised; unconstrained, of degree 1, may flip"
    citation: ClassVar[str] = (
        "Friedel, Schröder & Desbrun, Unconstrained Spherical Parameterization, journal of "
        "graphics tools 2007 (SIGGRAPH sketches 2005)"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    area_weight: float = Field(
        0.99,
        ge=0,
        le=1,
        description="share of the area term; the rest is Dirichlet energy, which keeps angles",
    )
    max_iterations: int = Field(100, ge=1, le=10_000, description="quasi-Newton steps at most")
    tolerance: float = Field(
        1e-8, ge=0, lt=1, description="stop when a step lowers the energy by less than this share"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.hierarchy.embedding import embed
        from gipkg.parametrizers.unconstrained import energy, quasi_newton
        from gipkg.surfaces.angles import corner_cotangents
        from gipkg.surfaces.areas import face_areas
        from gipkg.surfaces.validation import check_genus_zero

        check_genus_zero(mesh)
        vertices = np.asarray(mesh.vertices, np.float64)
        faces = np.asarray(mesh.faces, np.int64)
        cotangents = corner_cotangents(vertices, faces)
        areas = face_areas(vertices, faces)
        areas *= 4 * np.pi / areas.sum()
        # Angles are clamped to [1°, 89°], as the authors do: negative weights fold faces over.
        cotangents = cotangents.clip(*(1 / np.tan(np.radians((89, 1)))))
        return quasi_newton.minimize(
            energy.ProjectedEnergy(faces, cotangents, areas, self.area_weight),
            embed(vertices, faces, areas),
            quasi_newton.laplacian_preconditioner(faces, cotangents, areas),
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            callback=callback,
        )
