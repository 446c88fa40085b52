"""How far two surfaces are from each other: what a geometry image keeps of a shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.surfaces.validation import face_areas

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
    ways = [_distances(one, two, samples, rng) for one, two in ((mesh, other), (other, mesh))]
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    return SurfaceDistance(
        hausdorff=float(max(largest for largest, _ in ways) / diagonal),
        mean=float(np.mean([mean for _, mean in ways]) / diagonal),
    )


def _distances(
    source: trimesh.Trimesh, target: trimesh.Trimesh, samples: int, rng: np.random.Generator
) -> tuple[float, float]:
    """Return the largest distance of all samples and the mean one of the random samples."""
    import igl

    vertices, faces = np.asarray(source.vertices), np.asarray(source.faces, dtype=np.int64)
    points = np.vstack((_random_points(vertices, faces, samples, rng), vertices))
    squared, _, _ = igl.point_mesh_squared_distance(
        points, np.asarray(target.vertices), np.asarray(target.faces, dtype=np.int64)
    )
    distance = np.sqrt(squared)
    return float(distance.max()), float(distance[:samples].mean())


def _random_points(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    count: int,
    rng: np.random.Generator,
) -> NDArray[np.float64]:
    """Draw (count, 3) points on a surface, uniformly by area."""
    areas = face_areas(vertices, faces)
    chosen = rng.choice(len(faces), count, p=areas / areas.sum())
    weights = rng.dirichlet(np.ones(3), count)  # uniform over a triangle
    points: NDArray[np.float64] = np.einsum("nk,nkd->nd", weights, vertices[faces[chosen]])
    return points
