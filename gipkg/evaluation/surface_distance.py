"""How far two surfaces are from each other: what a geometry image keeps of a shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh

from gipkg.surfaces.distance import sampled_distances
from gipkg.surfaces.triangles import Triangles

SAMPLES = 50_000
"""Random points on each surface, besides its vertices."""


@dataclass(frozen=True, slots=True)
class SurfaceDistance:
    """Distances between two surfaces, as shares of the first one's bounding box diagonal.

    Attributes
    ----------
    hausdorff : float
        The largest distance of a sample of either surface to the other surface.
    mean : float
        The mean distance of points spread evenly over one surface to the other, mean of both
        directions.
    """

    hausdorff: float
    mean: float


def surface_distance(
    mesh: trimesh.Trimesh, other: trimesh.Trimesh, *, samples: int = SAMPLES, seed: int = 0
) -> SurfaceDistance:
    """Measure the distance between two surfaces by samples of each to the faces of the other.

    Samples are the vertices and random points, uniform by area. The distance of a point to a
    surface is exact (N. Aspert, D. Santa-Cruz, T. Ebrahimi, MESH: Measuring Errors between
    Surfaces using the Hausdorff Distance, ICME 2002).

    Parameters
    ----------
    mesh, other : trimesh.Trimesh
        Surfaces with an area; the bounding box is that of `mesh`.
    samples : int
        Random points on each surface.
    seed : int
        Of the random points.

    Returns
    -------
    SurfaceDistance
    """
    rng = np.random.default_rng(seed)
    one, two = Triangles.of(mesh), Triangles.of(other)
    ways = [sampled_distances(*pair, samples, rng) for pair in ((one, two), (two, one))]
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    return SurfaceDistance(
        hausdorff=float(max(way.max() for way in ways) / diagonal),
        mean=float(np.mean([way[:samples].mean() for way in ways]) / diagonal),
    )
