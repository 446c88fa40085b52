"""How thick a shape is at its points: the ball that touches the surface there from within."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.spatial import cKDTree

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.vertex_normals import vertex_normals

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators

LARGEST = 1 / np.sqrt(4 * np.pi)
"""Radius of a ball of unit area: by the isoperimetric inequality none inside is larger."""
FIRST_SEPARATION = 1.0
"""Degrees; the first contact counts even where the surface is nearly a sphere."""


class Thickness(Descriptor):
    """Radius of the largest ball inside that touches the surface at a point, at unit area.

    Its centre is on the medial axis. A ball on the inward normal shrinks until no vertex is
    inside. A contact near the point, seen from the centre under less than the `separation`, is
    taken for roughness of the surface and shrinks the ball no more.

    Limbs keep their thickness when they bend: the descriptor hardly changes under articulation.
    """

    summary: ClassVar[str] = "Radius of the medial ball at each point, at unit area"
    citation: ClassVar[str] = (
        "J. Ma, S. W. Bae, S. Choi: 3D Medial Axis Point Approximation Using Nearest Neighbors and "
        "the Normal Field. The Visual Computer 28(1), 2012"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    separation: float = Field(
        35.0, ge=0, lt=180, description="Least angle, in degrees, between two contacts of a ball"
    )
    logarithm: bool = Field(True, description="Logarithm of the radius; false gives it as it is")

    def channels(self) -> tuple[str, ...]:
        """Name of the channel, ``log-`` in front where it is logarithmic."""
        return ("log-thickness" if self.logarithm else "thickness",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Shrink the balls at the vertices of `mesh`; (V, 1)."""
        vertices = np.asarray(mesh.vertices, dtype=np.float64)
        normals = vertex_normals(vertices, np.asarray(mesh.faces))
        unit = np.sqrt(operators.mass.sum())
        radii = shrunken_balls(vertices / unit, normals, self.separation)[:, None]
        return np.log(radii) if self.logarithm else radii


def shrunken_balls(
    points: NDArray[np.float64], normals: NDArray[np.float64], separation: float
) -> NDArray[np.float64]:
    """Return the radii (V,) of balls that touch points (V, 3) from within.

    Parameters
    ----------
    points : (V, 3) array
        On a surface of unit area, no two the same.
    normals : (V, 3) array
        Unit vectors, outwards.
    separation : float
        Degrees.
    """
    tree = cKDTree(points)
    radii = np.full(len(points), LARGEST)
    active, least = np.arange(len(points)), FIRST_SEPARATION
    while len(active):
        own, normal, radius = points[active], normals[active], radii[active]
        distances, nearest = tree.query(own - radius[:, None] * normal, k=2)
        second = (nearest[:, 0] == active).astype(int)
        rows = np.arange(len(active))
        contact, distance = points[nearest[rows, second]], distances[rows, second]
        # The ball through both points with its centre on the normal: |p - q|² / 2 (p - q)·n.
        apart = own - contact
        depth = np.einsum("vi,vi->v", apart, normal)
        with np.errstate(divide="ignore"):
            smaller = np.einsum("vi,vi->v", apart, apart) / (2 * np.maximum(depth, 0.0))
        # Of the two contacts, seen from its centre.
        cosines = 1 - depth / smaller
        shrinks = (distance < radius * (1 - 1e-6)) & (smaller < radius * (1 - 1e-6))
        shrinks &= cosines < np.cos(np.deg2rad(least))
        active = active[shrinks]
        radii[active] = smaller[shrinks]
        least = max(separation, FIRST_SEPARATION)
    return radii
