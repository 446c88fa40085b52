"""The conformal map: angles kept, areas at their mercy."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags


class Conformal(Parametrizer):
    """Bijective spherical map of least angle distortion, its mass centre at the origin.

    The publication descends the harmonic energy. On meshes with limbs that flips faces: a limb
    shrinks exponentially, and thin or obtuse triangles turn over. Here the conformal energy
    (Dirichlet energy over area) is minimised face by face; of smooth maps both energies have the
    same minima, but this one is infinite at a flip. A weak area term keeps limbs representable.
    At the end a Möbius transformation centres the map, as there.
    """

    summary: ClassVar[str] = "angle-preserving, bijective even where limbs shrink to nothing"
    citation: ClassVar[str] = (
        "Gu, Wang, Chan, Thompson & Yau, Genus zero surface conformal mapping and its application "
        "to brain surface mapping, IEEE TMI 2004; energy after Hormann & Greiner, MIPS, 2000"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(
        guarantees=frozenset({"bijective", "angle"}), iterative=True
    )

    area_weight: float = Field(
        1e-3,
        gt=0,
        le=1,
        description="weight of areas against angles; below 1e-3 thin limbs leave double precision",
    )
    max_iterations: int = Field(200, ge=1, le=10_000, description="Gauss-Newton steps at most")
    tolerance: float = Field(
        1e-3, ge=0, lt=1, description="stop when a step lowers the energy by less than this share"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.sphere.moebius import centred
        from gipkg.parametrizers.variational.optimal_map import least_distorted_map
        from gipkg.surfaces.areas import at_vertices, face_areas

        sphere = least_distorted_map(
            mesh,
            area_weight=self.area_weight,
            shape_weight=1.0,
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            callback=callback,
        )
        vertices = np.asarray(mesh.vertices, np.float64)
        faces = np.asarray(mesh.faces, np.int64)
        masses = at_vertices(face_areas(vertices, faces), faces, len(vertices))
        return centred(sphere, faces, masses)
