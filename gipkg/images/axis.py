"""Where the vertical axis through the centroid of a surface meets it."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.surfaces.areas import at_vertices, face_areas

ON_THE_FACE = -1e-12
"""Least barycentric weight of a hit; below 0, so that an axis through an edge is no miss."""


def area_centroid(mesh: trimesh.Trimesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the centroid (3,) of the surface and the areas (V,) of its vertices.

    A vertex has a third of each face around it.
    """
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    areas = at_vertices(face_areas(vertices, faces), faces, len(vertices))
    return areas @ vertices / areas.sum(), areas


def highest_on_axis(
    mesh: trimesh.Trimesh, centroid: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Find the highest point of a surface on the vertical line through a point.

    Where the line passes through a gap (between the legs of a chair whose seat is not centred),
    it is the vertex nearest to the line, and of several the highest.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        With z pointing up.
    centroid : (3,) array
        The height of it does not matter.

    Returns
    -------
    corners : (3,) int64 array
        Vertices of the face that the point lies in.
    weights : (3,) float64 array
        Its barycentric coordinates there: none negative, sum 1.
    """
    vertices, faces = np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces)
    flat = vertices[faces, :2] - centroid[:2]
    following = np.roll(flat, -1, axis=1)
    # Opposite to corner i lies edge (i + 1, i + 2): twice the area that it spans with the axis.
    spans = np.roll(flat[..., 0] * following[..., 1] - flat[..., 1] * following[..., 0], -1, axis=1)
    doubled = spans.sum(axis=1)
    weights = np.divide(
        spans, doubled[:, None], out=np.full_like(spans, -1.0), where=doubled[:, None] != 0
    )
    hits = np.flatnonzero((weights >= ON_THE_FACE).all(axis=1))
    if hits.size == 0:
        from_axis = np.linalg.norm(vertices[:, :2] - centroid[:2], axis=1)
        nearest = np.lexsort((-vertices[:, 2], from_axis))[0]
        return np.full(3, nearest), np.array([1.0, 0.0, 0.0])
    heights = np.einsum("hc,hc->h", weights[hits], vertices[faces[hits], 2])
    top = hits[np.argmax(heights)]
    inside = np.maximum(weights[top], 0.0)
    return faces[top], inside / inside.sum()
