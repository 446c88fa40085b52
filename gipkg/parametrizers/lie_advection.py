"""Lie advection: the area form of a start map, carried by a flow to that of the sphere."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Iteration, Parametrizer, ParametrizerTags
from gipkg.parametrizers.flow.starts import Start, start_map
from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.validation import check_genus_zero


class LieAdvection(Parametrizer):
    """Diffeomorphic flow on the sphere that makes the density of the mesh uniform.

    One Poisson equation on the triangulation that the start makes of the sphere gives the field;
    the vertices follow it from t = 0 to 1, and what lies between them is interpolated. The smooth
    flow is a diffeomorphism and its end authalic. The vertices are not all of it: triangles
    between them flip where the flow shears them or where the triangulation is too coarse for the
    field, as it does on limbs, so nothing is promised.

    The publication starts from a conformal map. There the density of limbs is extreme and the
    flow at its worst; the default is the start that the other flow has, which favours this one.
    """

    summary: ClassVar[str] = "advection of the area form; faces may flip on limbs"
    citation: ClassVar[str] = (
        "Zou, Hu, Gu & Hua, Authalic Parameterization of General Surfaces Using Lie Advection, "
        "IEEE TVCG 2011; flow after Moser, On the Volume Elements on a Manifold, Trans. AMS 1965"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    iterations: int = Field(100, ge=1, le=100_000, description="steps from t = 0 to 1")
    start: Start = Field("hierarchy", description="map that the flow starts from")

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.flow.lie import LieFlow
        from gipkg.parametrizers.sphere.areas import mean_square_distortion

        check_genus_zero(mesh)
        faces = np.asarray(mesh.faces, np.int64)
        areas = face_areas(np.asarray(mesh.vertices, np.float64), faces)
        areas *= 4 * np.pi / areas.sum()
        flow = LieFlow(start_map(mesh, self.start), faces, areas)

        def tell(number: int, step: float) -> None:
            if callback:
                objective = mean_square_distortion(flow.points, faces, areas)
                callback(Iteration(number, flow.points, objective, step))

        tell(0, 0.0)
        for number in range(1, self.iterations + 1):
            flow.advance((number - 1) / self.iterations, 1 / self.iterations)
            tell(number, 1.0)
        return flow.points
