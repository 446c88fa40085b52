"""Where a geometry image is cut, as lines on the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.images.location import locate
from gipkg.reporting.octahedron import edges

_POINTS = 400
"""Points that a line is drawn by: several a face."""


def cut_lines(spherical_map: SphericalMap, cut: Rotation) -> list[NDArray[np.float64]]:
    """Return the four edges that are opened, on the mesh, each from the south pole outward.

    Parameters
    ----------
    spherical_map : SphericalMap
        Covers the sphere.
    cut : Rotation
        Applied to the sphere before it is cut.

    Returns
    -------
    list of (N, 3) float64 arrays
        Points on the faces of the mesh.

    Raises
    ------
    UnsupportedMesh
        The map does not cover the sphere.
    """
    share = np.linspace(0, 1, _POINTS)[:, None]
    chords = [(1 - share) * edge.start + share * edge.end for edge in edges() if edge.cut]
    return [points_at(spherical_map, cut.inv().apply(chord)) for chord in chords]


def points_at(spherical_map: SphericalMap, directions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the points (N, 3) of the mesh that a map puts in N directions of any length.

    Raises
    ------
    UnsupportedMesh
        The map does not cover the sphere.
    """
    mesh = spherical_map.mesh
    faces, vertices = np.asarray(mesh.faces), np.asarray(mesh.vertices, dtype=np.float64)
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    face, weights, uncovered = locate(spherical_map.sphere, faces, unit, len(unit))
    if uncovered >= 0:
        raise UnsupportedMesh(f"no face of the spherical map covers {unit[uncovered]}")
    points: NDArray[np.float64] = np.einsum("nk,nkj->nj", weights, vertices[faces[face]])
    return points
