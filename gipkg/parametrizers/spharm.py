"""The CALD map of SPHARM: area and length distortions controlled by local and global smoothing."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Iteration, Parametrizer, ParametrizerTags


class Spharm(Parametrizer):
    """Map that evens out areas without stretching lengths at will, by alternate smoothing.

    In turn the whole sphere is warped, which evens out areas on a large scale, and every vertex
    is moved within its star, which evens them out on a small one unless lengths suffer. Nothing
    keeps faces from flipping: on limbs a few usually do.
    """

    summary: ClassVar[str] = "control of area and length distortion (CALD); may flip faces"
    citation: ClassVar[str] = (
        "Shen & Makedon, Spherical mapping for processing of 3D closed surfaces, Image and Vision "
        "Computing 2006; start after Brechbühler, Gerig & Kübler, Parametrization of closed "
        "surfaces for 3-D shape description, CVIU 1995"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    start: Literal["diffusion", "hierarchy"] = Field(
        "diffusion",
        description="latitude and longitude by diffusion, as published, or the bijective start",
    )
    iterations: int = Field(100, ge=1, le=10_000, description="turns of global, local smoothing")
    sweeps: int = Field(2, ge=1, le=100, description="local smoothings of every vertex in a turn")
    length_limit: float = Field(
        2.0,
        ge=1,
        description="a vertex moves if no length around it is changed by more than this factor",
    )
    degree: int = Field(
        6, ge=1, le=20, description="of the harmonics that global smoothing evens areas out with"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`).

        The objective told to the callback is the squared relative error of the areas of faces,
        averaged over the surface; the step is the share of the warp that was made.
        """
        from gipkg.parametrizers.cald.diffusion import diffuse
        from gipkg.parametrizers.cald.global_smoothing import smooth_globally
        from gipkg.parametrizers.cald.local_smoothing import smooth_locally
        from gipkg.parametrizers.cald.stars import Stars
        from gipkg.parametrizers.hierarchy.embedding import embed
        from gipkg.parametrizers.sphere.areas import mean_square_distortion
        from gipkg.surfaces.angles import corner_cotangents
        from gipkg.surfaces.areas import face_areas
        from gipkg.surfaces.validation import check_genus_zero

        check_genus_zero(mesh)
        vertices = np.asarray(mesh.vertices, np.float64)
        faces = np.asarray(mesh.faces, np.int64)
        cotangents = corner_cotangents(vertices, faces)
        areas = face_areas(vertices, faces)
        areas *= 4 * np.pi / areas.sum()
        stars = Stars.of(faces)
        # A tetrahedron has no two vertices that could be poles.
        if self.start == "diffusion" and len(vertices) > 4:
            sphere = diffuse(vertices, stars)
        else:
            sphere = embed(vertices, faces, areas)
        if callback:
            callback(Iteration(0, sphere, mean_square_distortion(sphere, faces, areas), 0.0))
        for number in range(1, self.iterations + 1):
            sphere, share = smooth_globally(sphere, faces, areas, self.degree, axis=number % 3)
            smooth_locally(sphere, stars, areas, cotangents, self.length_limit, self.sweeps)
            if callback:
                callback(
                    Iteration(number, sphere, mean_square_distortion(sphere, faces, areas), share)
                )
        return sphere
