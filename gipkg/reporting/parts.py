"""What a map, and the image made of it, leave of the parts of a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.evaluation.distortion import distortion
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.images.lookup import PixelLookup
from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.reporting.tips import Tips
from gipkg.surfaces.distance import distances
from gipkg.surfaces.triangles import Triangles

WHOLE = "whole"
"""Name of the part that is the whole surface."""


@dataclass(frozen=True, slots=True)
class Part:
    """A tip under a map, or the whole surface.

    Attributes
    ----------
    parametrizer : str
    part : str
        `WHOLE`, or ``tip 1`` for the end of the limb that reaches farthest from the middle.
    vertices : int
    mesh_share, sphere_share : float
        Shares of the whole area, a vertex having a third of its faces.
    area_ratio : float
        Sphere over mesh.
    area_ratio_std : float
        Standard deviation of the ratio over the faces that touch the part.
    flips : int
        Flipped ones among these faces.
    pixels : int
        Of the geometry image, whose nearest vertex is in the part.
    largest_distance, mean_distance : float
        Of the part's vertices to the reconstruction, as shares of the bounding box's diagonal.
    hausdorff : float
        Between the surface and its reconstruction, both ways; NaN for a tip.
    """

    parametrizer: str
    part: str
    vertices: int
    mesh_share: float
    sphere_share: float
    area_ratio: float
    area_ratio_std: float
    flips: int
    pixels: int
    largest_distance: float
    mean_distance: float
    hausdorff: float


def measure(
    parametrizer: str,
    spherical_map: SphericalMap,
    located: PixelLookup,
    reconstruction: trimesh.Trimesh,
    tips: Tips,
) -> tuple[Part, ...]:
    """Measure the whole surface and then each tip.

    Parameters
    ----------
    parametrizer : str
        Name of the method.
    spherical_map : SphericalMap
    located : PixelLookup
        Of the geometry image.
    reconstruction : trimesh.Trimesh
        From the geometry image of the positions.
    tips : Tips
    """
    mesh = spherical_map.mesh
    faces, areas = np.asarray(mesh.faces), distortion(spherical_map)
    ratio = areas.spherical_areas / areas.mesh_areas
    flipped = flipped_faces(spherical_map.sphere, faces)
    nearest, distance = located.nearest, _distances(mesh, reconstruction)

    def part(name: str, inside: NDArray[np.bool_], hausdorff: float) -> Part:
        corners = inside[faces]
        touching = corners.any(axis=1)
        on_mesh, on_sphere = (
            float(corners.sum(axis=1) @ each / (3 * each.sum()))
            for each in (areas.mesh_areas, areas.spherical_areas)
        )
        return Part(
            parametrizer,
            name,
            vertices=int(inside.sum()),
            mesh_share=on_mesh,
            sphere_share=on_sphere,
            area_ratio=on_sphere / on_mesh,
            area_ratio_std=float(ratio[touching].std()),
            flips=int(flipped[touching].sum()),
            pixels=int(inside[nearest].sum()),
            largest_distance=float(distance[inside].max()),
            mean_distance=float(distance[inside].mean()),
            hausdorff=hausdorff,
        )

    everything = np.ones(len(mesh.vertices), dtype=bool)
    hausdorff = surface_distance(mesh, reconstruction).hausdorff
    limbs = range(len(tips.vertex))
    return (
        part(WHOLE, everything, hausdorff),
        *(part(f"tip {tip + 1}", tips.region == tip, float("nan")) for tip in limbs),
    )


def _distances(mesh: trimesh.Trimesh, other: trimesh.Trimesh) -> NDArray[np.float64]:
    """Distance (V,) of each vertex to another surface, by the bounding box's diagonal."""
    vertices = np.asarray(mesh.vertices, dtype=np.float64)
    return distances(vertices, Triangles.of(other)) / np.linalg.norm(np.ptp(vertices, axis=0))
