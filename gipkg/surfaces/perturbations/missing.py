"""Parts of a surface that a scanner did not see."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra

from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.edge_graph import edge_graph

HOLES = 8
"""Small holes in a surface, of equal areas."""


def remove_holes(
    mesh: trimesh.Trimesh, strength: float, rng: np.random.Generator
) -> trimesh.Trimesh:
    """Remove `HOLES` discs of equal areas, about points that are uniform over the surface.

    Parameters
    ----------
    mesh : trimesh.Trimesh
    strength : float
        Share of the surface that is removed, all holes together.
    rng : numpy.random.Generator
    """
    return _without_discs(mesh, HOLES, strength / HOLES, rng)


def remove_region(
    mesh: trimesh.Trimesh, strength: float, rng: np.random.Generator
) -> trimesh.Trimesh:
    """Remove what is nearest, along the surface, to one point.

    Parameters
    ----------
    mesh : trimesh.Trimesh
    strength : float
        Share of the surface that is removed.
    rng : numpy.random.Generator
    """
    return _without_discs(mesh, 1, strength, rng)


def _without_discs(
    mesh: trimesh.Trimesh, count: int, share: float, rng: np.random.Generator
) -> trimesh.Trimesh:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    areas = face_areas(vertices, faces)
    centres = rng.choice(len(faces), count, replace=False, p=areas / areas.sum())
    distances = dijkstra(edge_graph(vertices, faces), indices=faces[centres, 0])
    kept = np.ones(len(faces), bool)
    for distance in distances:
        kept[_nearest(distance[faces].max(axis=1), areas, share)] = False
    return trimesh.Trimesh(vertices, faces[kept], process=False)


def _nearest(
    distance: NDArray[np.float64], areas: NDArray[np.float64], share: float
) -> NDArray[np.int64]:
    """Return the faces, by their distance (F,), that make up a share of all areas (F,)."""
    order = np.argsort(distance, kind="stable")
    covered = np.cumsum(areas[order]) / areas.sum()
    return order[: np.searchsorted(covered, share) + 1]
