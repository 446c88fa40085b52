"""Where on a shape a point is, on the surface scaled to unit area and seen from its centroid."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api import Descriptor, DescriptorTags

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators

CITATION = (
    "A. Sinha, J. Bai, K. Ramani: Deep Learning 3D Shape Surfaces Using Geometry Images. ECCV, 2016"
)


def offsets(mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
    """Return the offsets (V, 3) of the vertices from the centroid, at unit area."""
    mass = operators.mass
    vertices = np.asarray(mesh.vertices, dtype=np.float64)
    return np.asarray((vertices - mass @ vertices / mass.sum()) / np.sqrt(mass.sum()))


class Position(Descriptor):
    """Coordinates from the centroid of the surface, in units of the root of its area."""

    summary: ClassVar[str] = "Coordinates x, y, z from the centroid, at unit area"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Names of the three axes."""
        return ("x", "y", "z")

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Centre and scale the vertices; (V, 3)."""
        return offsets(mesh, operators)


class Height(Descriptor):
    """Coordinate along the z axis, which has to be the upright one, from the centroid."""

    summary: ClassVar[str] = "Height above the centroid, at unit area; z is up"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Name of the channel."""
        return ("height",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Measure the heights; (V, 1)."""
        return offsets(mesh, operators)[:, 2:]


class CentroidDistance(Descriptor):
    """Distance to the centroid of the surface, in units of the root of its area."""

    summary: ClassVar[str] = "Distance to the centroid, at unit area"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Name of the channel."""
        return ("centroid-distance",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Measure the distances; (V, 1)."""
        return np.linalg.norm(offsets(mesh, operators), axis=1, keepdims=True)
