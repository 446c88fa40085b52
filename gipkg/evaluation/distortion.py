"""What a spherical map does to areas (paper, Section 5; one meaning per number)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from gipkg.surfaces.areas import at_vertices, face_areas


@dataclass(frozen=True, slots=True)
class Distortion:
    """Areas of a map and what follows from them.

    Both surfaces are scaled to a total area of 4π; r is sphere area over mesh area.

    Attributes
    ----------
    spherical_areas : (F,) float64 array
        Signed areas on the sphere, in steradians.
    mesh_areas : (F,) float64 array
        Areas on the mesh, scaled to sum to 4π.
    flips : int
        Faces whose signed area is not positive, decided exactly.
    degree : float
        Signed areas over 4π; 1 for a map that covers the sphere once.
    face_std, vertex_std : float
        Standard deviation of r - 1 over faces, and over vertices (a third of their faces).
    weighted_face_std : float
        The same over the surface rather than over its faces: each counts by its area on the
        mesh, so that slivers weigh as little as they are.
    variance : float
        The paper's δh·A: variance over faces of sphere area minus mesh area. It falls with
        resolution: compare it at equal numbers of faces only.
    """

    spherical_areas: NDArray[np.float64]
    mesh_areas: NDArray[np.float64]
    flips: int
    degree: float
    face_std: float
    vertex_std: float
    weighted_face_std: float
    variance: float


def distortion(spherical_map: SphericalMap) -> Distortion:
    """Measure the area distortion of a spherical map.

    Parameters
    ----------
    spherical_map : SphericalMap
        Map of a mesh whose faces all have an area.

    Returns
    -------
    Distortion

    Raises
    ------
    UnsupportedMesh
        A face of the mesh has none.
    """
    faces = np.asarray(spherical_map.mesh.faces)
    on_mesh = face_areas(np.asarray(spherical_map.mesh.vertices), faces)
    if not on_mesh.all():
        raise UnsupportedMesh(
            "faces of its mesh have no area, so that nothing can be said of areas; gipkg.prepare "
            "resolves them"
        )
    on_mesh *= 4 * np.pi / on_mesh.sum()
    on_sphere = signed_spherical_areas(spherical_map.sphere, faces)
    ratio = on_sphere / on_mesh
    mean = np.average(ratio, weights=on_mesh)
    count = int(faces.max()) + 1
    vertex_ratio = at_vertices(on_sphere, faces, count) / at_vertices(on_mesh, faces, count)
    return Distortion(
        spherical_areas=on_sphere,
        mesh_areas=on_mesh,
        flips=int(np.count_nonzero(flipped_faces(spherical_map.sphere, faces))),
        degree=float(on_sphere.sum() / (4 * np.pi)),
        face_std=float(np.std(ratio)),
        vertex_std=float(np.std(vertex_ratio)),
        weighted_face_std=float(np.sqrt(np.average((ratio - mean) ** 2, weights=on_mesh))),
        variance=float(np.var(on_sphere - on_mesh)),
    )
