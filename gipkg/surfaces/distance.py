"""How far points are from a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.triangles import Triangles

SAMPLES = 10_000
"""Random points on each surface, besides its vertices."""

FAR = 0.02
"""Distance, in diagonals, from which on what was given counts as missing."""


@dataclass(frozen=True, slots=True)
class Deviation:
    """How far what was prepared is from what was given, in diagonals of the latter's box.

    Attributes
    ----------
    lost : float
        The largest distance from what was given to the surface: to parts that were dropped, or
        are inside now.
    added : float
        The largest distance from the surface to what was given: to what closes it. The greater
        of the two is the Hausdorff distance.
    mean : float
        The mean distance of points spread evenly over one to the other, mean of both directions.
    missing : float
        Share of the area of what was given that is farther than `FAR` from the surface.
    """

    lost: float
    added: float
    mean: float
    missing: float


def deviation(given: Triangles, surface: Triangles) -> Deviation:
    """Measure both ways, by random points and the vertices, how far two surfaces are apart."""
    rng = np.random.default_rng(0)
    given = given.compact()
    diagonal = np.linalg.norm(np.ptp(given.vertices, axis=0))
    there = sampled_distances(given, surface, SAMPLES, rng) / diagonal
    back = sampled_distances(surface, given, SAMPLES, rng) / diagonal
    return Deviation(
        lost=float(there.max()),
        added=float(back.max()),
        mean=float(there[:SAMPLES].mean() + back[:SAMPLES].mean()) / 2,
        missing=float((there[:SAMPLES] > FAR).mean()),
    )


def sampled_distances(
    source: Triangles, target: Triangles, samples: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Return the distances from points on one surface, that has an area, to another.

    Returns
    -------
    (samples + V,) array
        Of random points on `source`, uniform by area, and of its V vertices.
    """
    return distances(np.vstack((random_points(source, samples, rng), source.vertices)), target)


def distances(points: NDArray[np.float64], surface: Triangles) -> NDArray[np.float64]:
    """Return the (n,) exact distances of (n, 3) points to the nearest face of a surface."""
    import igl

    squared, _, _ = igl.point_mesh_squared_distance(points, surface.vertices, surface.faces)
    return np.asarray(np.sqrt(squared))


def random_points(surface: Triangles, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw (count, 3) points on a surface, uniformly by area."""
    areas = face_areas(surface.vertices, surface.faces)
    chosen = rng.choice(len(areas), count, p=areas / areas.sum())
    weights = rng.dirichlet(np.ones(3), count)  # uniform over a triangle
    corners = surface.vertices[surface.faces[chosen]]
    points: NDArray[np.float64] = np.einsum("nk,nkd->nd", weights, corners)
    return points
