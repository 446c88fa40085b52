"""The tips of a surface's limbs: what a map that is not area-preserving loses first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from gipkg.surfaces.areas import at_vertices, face_areas
from gipkg.surfaces.edge_graph import edge_graph

AREA = 0.02
"""Share of the surface's area that counts as one tip."""

_REACH = 0.25
"""Within this share of the largest distance from the middle, a tip is the farthest point."""
_SLENDER = 0.6
"""Around a tip, the surface within reach has less than this share of a flat disc's area."""


@dataclass(frozen=True, slots=True)
class Tips:
    """The regions around the ends of limbs.

    Attributes
    ----------
    vertex : (T,) int64 array
        The ends, farthest from the middle of the surface first; none on a ball.
    region : (V,) int64 array
        For each vertex the tip it belongs to, -1 for none.
    """

    vertex: NDArray[np.int64]
    region: NDArray[np.int64]


def limb_tips(mesh: trimesh.Trimesh, area: float = AREA) -> Tips:
    """Find the tips of a surface.

    A tip is farther from the surface's middle, along the edges, than all that is within reach
    of it, and what is within its reach is slender. Its region is what is nearest to it, up to
    a share of the surface's area.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Of one component; V vertices.
    area : float
        Share of the surface's area that one region has, up to one vertex.
    """
    graph = edge_graph(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    areas = vertex_shares(mesh)
    outward = dijkstra(graph, indices=_middle(graph))
    reach = _REACH * outward.max()
    highest = np.maximum.reduceat(outward[graph.indices], graph.indptr[:-1])
    candidates = np.flatnonzero(outward >= highest)
    near = np.isfinite(dijkstra(graph, indices=candidates, limit=reach))
    is_farthest = outward[candidates] >= np.where(near, outward, 0.0).max(axis=1)
    is_slender = mesh.area * (near @ areas) < _SLENDER * np.pi * reach**2
    tips = candidates[is_farthest & is_slender]
    tips = tips[np.argsort(-outward[tips], kind="stable")]
    return Tips(tips, _regions(dijkstra(graph, indices=tips), areas, area))


def vertex_shares(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Return the share (V,) of each vertex in the area: a third of its faces."""
    faces = np.asarray(mesh.faces)
    areas = face_areas(np.asarray(mesh.vertices), faces)
    return at_vertices(areas / areas.sum(), faces, len(mesh.vertices))


def _middle(graph: csr_array) -> int:
    """Return the vertex halfway between ends, by its greatest distance to three far points."""
    far = [0]
    distances = []
    for _ in range(4):
        distances.append(dijkstra(graph, indices=far[-1]))
        far.append(int(np.argmax(distances[-1])))
    return int(np.argmin(np.max(distances[1:], axis=0)))


def _regions(
    distances: NDArray[np.float64], areas: NDArray[np.float64], share: float
) -> NDArray[np.int64]:
    """Give each of T tips the vertices nearest to it, up to a share of the area: (V,)."""
    region = np.full(len(areas), -1)
    for tip, distance in enumerate(distances):
        order = np.argsort(distance, kind="stable")
        inside = order[np.cumsum(areas[order]) <= share]
        region[inside] = tip
    return region
