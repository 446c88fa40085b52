"""One iteration of the paper's flow (Section 3, steps 1 to 3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.flow.linear_elements import LinearElements
from gipkg.parametrizers.flow.poisson import Poisson
from gipkg.parametrizers.flow.transfer import carry_all, carry_carefully, destinations
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.surfaces.areas import at_vertices, face_areas
from gipkg.surfaces.halfedges import corners_by_vertex


class AreaFlow:
    """What the iterations on one mesh share.

    Parameters
    ----------
    vertices : (V, 3) float64 array
        In any unit; scaled to a surface of area 4π.
    faces : (F, 3) int64 array
    rank : int, optional
        Of the Laplacian's pseudo-inverse; exact if not given.
    """

    def __init__(
        self, vertices: NDArray[np.float64], faces: NDArray[np.int64], rank: int | None = None
    ) -> None:
        scale = np.sqrt(4 * np.pi / face_areas(vertices, faces).sum())
        self.elements = LinearElements(scale * vertices, faces)
        self._poisson = Poisson(self.elements.stiffness(), rank)
        self._areas = at_vertices(self.elements.areas, faces, len(vertices))
        self._fan_starts, self._fans = corners_by_vertex(faces, len(vertices))

    def advance(
        self, sphere: NDArray[np.float64], *, step: float, integrated: bool, guard: bool
    ) -> tuple[NDArray[np.float64], float]:
        """Make one iteration.

        Parameters
        ----------
        sphere : (V, 3) float64 array
            Unit vectors; not changed.
        step : float
            ρ of equation 5.
        integrated : bool
            Right-hand side A_s - A instead of δh.
        guard : bool
            Let no face flip and no star grow more distorted.

        Returns
        -------
        sphere : (V, 3) float64 array
            Unit vectors.
        moved : float
            Share of the vertices that moved.
        """
        elements = self.elements
        on_sphere = signed_spherical_areas(sphere, elements.faces)
        excess = at_vertices(on_sphere, elements.faces, elements.count) - self._areas
        potential = self._poisson.solve(excess if integrated else excess / self._areas)
        corners, rates = destinations(
            elements.faces, elements.hats, elements.vertex_gradients(potential)
        )
        moved = sphere.copy()
        if not guard:
            carry_all(moved, elements.faces, corners, rates, step)
            return moved, 1.0
        count = carry_carefully(
            moved, elements.faces, elements.areas, self._fan_starts, self._fans, corners, rates,
            step,
        )  # fmt: skip
        return moved, count / len(moved)
