"""Which way a surface faces: as it is, against gravity, and away from the centroid."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.position import CITATION, offsets
from gipkg.descriptors.vertex_normals import vertex_normals

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


def _normals(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    return vertex_normals(np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces))


class Normals(Descriptor):
    """The outward unit normal."""

    summary: ClassVar[str] = "Outward unit normal"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Names of its components."""
        return ("normal-x", "normal-y", "normal-z")

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Average the faces' normals at the vertices; (V, 3)."""
        return _normals(mesh)


class GravityAngle(Descriptor):
    """Angle between the outward normal and the direction of gravity, the paper's height field.

    Gravity pulls along -z: the angle is 0 where the surface faces down, π where it faces up.
    """

    summary: ClassVar[str] = "Angle of the outward normal to gravity, in radians; z is up"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Name of the channel."""
        return ("gravity-angle",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Measure the angles; (V, 1), 0 to π."""
        normals = _normals(mesh)
        # atan2 keeps its digits where the arc cosine of nearly ±1 does not.
        sines = np.hypot(normals[:, 0], normals[:, 1])
        return np.asarray(np.arctan2(sines, -normals[:, 2])[:, None], dtype=np.float64)


class RadialNormal(Descriptor):
    """Component of the outward normal that points away from the centroid.

    It is 1 on a sphere, and negative where the surface looks back to its centroid.
    """

    summary: ClassVar[str] = "Component of the outward normal away from the centroid"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    def channels(self) -> tuple[str, ...]:
        """Name of the channel."""
        return ("radial-normal",)

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Project the normals; (V, 1), -1 to 1, and 0 at the centroid itself."""
        away = offsets(mesh, operators)
        distance = np.linalg.norm(away, axis=1)
        along = np.einsum("vi,vi->v", _normals(mesh), away)
        cosines = np.divide(along, distance, out=np.zeros_like(along), where=distance > 0)
        return cosines[:, None]
