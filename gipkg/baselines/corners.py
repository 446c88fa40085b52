"""Corners of the faces of a mesh, moved and scaled so that neither place nor size matters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import trimesh


def about_area_centroid(mesh: trimesh.Trimesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the corners of the faces, relative to the centroid of the surface, and the areas.

    Returns
    -------
    corners : (F, 3, 3) float64 array
    areas : (F,) float64 array
    """
    from gipkg.surfaces.areas import face_areas

    vertices, faces = np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces)
    # Relative to a vertex, so that a far-away mesh loses no digits.
    vertices = vertices - vertices[faces[0, 0]]
    corners, areas = vertices[faces], face_areas(vertices, faces)
    return corners - areas @ corners.mean(axis=1) / areas.sum(), areas


def in_unit_ball(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale corners (F, 3, 3) so that the farthest from the origin is at distance 1."""
    return corners / np.linalg.norm(corners, axis=2).max()
