"""The solid that a closed mesh bounds: its volume, its centroid and its principal axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import UnsupportedMesh

if TYPE_CHECKING:
    import trimesh


def require_solid(mesh: trimesh.Trimesh) -> None:
    """Accept a mesh that encloses a positive volume.

    Raises
    ------
    UnsupportedMesh
        The volume is zero or negative, as of a mesh that is flat or inside out.
    """
    _cones(mesh)


def about_volume_centroid(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Return the corners (F, 3, 3) of the faces, relative to the centroid of the solid.

    Raises
    ------
    UnsupportedMesh
        The mesh encloses no positive volume.
    """
    corners, volumes = _cones(mesh)
    return corners - volumes @ corners.sum(axis=1) / (4 * volumes.sum())


def principal_frame(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Return a rotation into the principal axes of the solid.

    Multiplied from the right to (V, 3) vertices, it makes the axis of the largest moment the z
    axis, and the third moment along it positive. What is left open is half a turn about it.

    Returns
    -------
    (3, 3) float64 array
        Orthonormal columns, determinant 1.

    Raises
    ------
    UnsupportedMesh
        The mesh encloses no positive volume.
    """
    corners = about_volume_centroid(mesh)
    volumes = np.linalg.det(corners)
    # The integrals of a quadratic and of a cubic over a tetrahedron with a corner at the origin,
    # by the sums over its other corners; constant factors do not matter here.
    weighted = corners * volumes[:, None, None]
    sums = corners.sum(axis=1)
    second = np.tensordot(weighted, corners, axes=([0, 1], [0, 1])) + weighted.sum(axis=1).T @ sums
    x, _, z = np.linalg.eigh(second)[1].T
    one, two, three = (((corners @ z) ** power).sum(axis=1) for power in (1, 2, 3))
    if volumes @ (one**3 + 3 * one * two + 2 * three) < 0:
        z = -z
    return np.stack([x, np.cross(z, x), z], axis=1)


def _cones(mesh: trimesh.Trimesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the corners (F, 3, 3) of the faces and six times the volumes (F,) of their cones.

    The apex of the cones and the origin of the corners is a vertex of the mesh, so that a
    far-away mesh loses no digits.
    """
    corners = np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces]
    corners = corners - corners[0, 0]
    volumes = np.linalg.det(corners)
    if not volumes.sum() > 0:
        raise UnsupportedMesh(
            f"the mesh encloses a volume of {volumes.sum() / 6:.3g}: it must be closed and its "
            "faces must be oriented outwards (gipkg.prepare does)"
        )
    return corners, volumes
