"""The flow that carries the area form of a start map to that of the sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.flow.advection import advect
from gipkg.parametrizers.flow.linear_elements import LinearElements
from gipkg.parametrizers.flow.poisson import Poisson
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.surfaces.areas import at_vertices
from gipkg.surfaces.halfedges import twins


class LieFlow:
    """Vertices on their way over the triangulation that a bijective map makes of the sphere.

    On the sphere the mesh has a density μ, its area by area of the sphere. The form
    ω_t = ((1 - t) μ + t) dA is advected by the field v_t = ∇φ / ((1 - t) μ + t) with Δφ = μ - 1:
    its Lie derivative along v_t is d(i_v ω_t) = Δφ dA = -∂ω_t/∂t. Where the flow has carried the
    vertices at t = 1, the density is 1.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors; no face is flipped.
    faces : (F, 3) int64 array
    areas : (F,) float64 array
        Of the faces of the mesh, summing to 4π.

    Attributes
    ----------
    points : (V, 3) float64 array
        The vertices where the flow has carried them; unit vectors.
    """

    def __init__(
        self,
        sphere: NDArray[np.float64],
        faces: NDArray[np.int64],
        areas: NDArray[np.float64],
    ) -> None:
        elements = LinearElements(sphere, faces)
        on_sphere = at_vertices(signed_spherical_areas(sphere, faces), faces, len(sphere))
        on_mesh = at_vertices(areas, faces, len(sphere))
        # The stiffness matrix is that of -Δ, and its right-hand side an integral.
        potential = Poisson(elements.stiffness()).solve(on_sphere - on_mesh)
        fluxes = elements.vertex_gradients(potential)
        self.points = sphere.copy()
        self._start = sphere
        self._faces = faces
        self._twins = twins(faces)
        self._fluxes = fluxes - sphere * np.einsum("ij,ij->i", fluxes, sphere)[:, None]
        self._densities = on_mesh / on_sphere
        self._hosts = np.zeros(len(sphere), np.int64)
        self._hosts[faces.ravel()] = np.arange(faces.size) // 3

    def advance(self, time: float, step: float) -> None:
        """Move the points from one time to `step` later, by Euler's method."""
        advect(
            self.points, self._hosts, self._start, self._faces, self._twins, self._fluxes,
            self._densities, time, step,
        )  # fmt: skip
