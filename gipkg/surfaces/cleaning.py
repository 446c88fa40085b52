"""Faces and vertices that say nothing new: duplicates, collapsed faces, seams."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from gipkg.surfaces import halfedges
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import repeats_vertex


def merge_border_vertices(mesh: Triangles, tolerance: float) -> tuple[Triangles, int]:
    """Merge vertices at open edges that lie at the same place, and count those merged.

    Only open edges are looked at: vertices that coincide elsewhere keep apart what touches
    without being joined.

    Parameters
    ----------
    mesh : Triangles
    tolerance : float
        Largest distance, as a share of the bounding box's diagonal.
    """
    edges = halfedges.group_edges(mesh.faces)
    origin, target = halfedges.endpoints(mesh.faces)
    open_edges = edges.halfedges(edges.count == 1)
    border = np.unique(np.concatenate((origin[open_edges], target[open_edges])))
    if not len(border):
        return mesh, 0
    points = mesh.vertices[border]
    radius = tolerance * float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))
    near = cKDTree(points).query_pairs(radius, output_type="ndarray")
    count, group = halfedges.label_connected(len(border), *near.T)
    _, first = np.unique(group, return_index=True)
    number = np.arange(len(mesh.vertices))
    number[border] = border[first[group]]
    return mesh.with_faces(number[mesh.faces]), len(border) - count


def remove_collapsed_faces(mesh: Triangles) -> tuple[Triangles, int]:
    """Remove the faces that name a vertex twice, and count them."""
    return _keep(mesh, ~repeats_vertex(mesh.faces))


def remove_duplicate_faces(mesh: Triangles) -> tuple[Triangles, int]:
    """Remove all but the first of the faces that say the same, and count them.

    Two faces on the same vertices in opposite directions are no duplicates but a folded
    sheet, which splitting can take off whole.
    """
    turn = np.argmin(mesh.faces, axis=1)[:, None] + np.arange(3)
    rotated = np.take_along_axis(mesh.faces, turn % 3, axis=1)
    _, first = np.unique(rotated, axis=0, return_index=True)
    keep = np.zeros(len(mesh.faces), bool)
    keep[first] = True
    return _keep(mesh, keep)


def remove_unused_vertices(mesh: Triangles) -> tuple[Triangles, int]:
    """Remove the vertices of no face, and count them."""
    compact = mesh.compact()
    return compact, len(mesh.vertices) - len(compact.vertices)


def _keep(mesh: Triangles, keep: NDArray[np.bool_]) -> tuple[Triangles, int]:
    removed = int(np.count_nonzero(~keep))
    return (mesh.with_faces(mesh.faces[keep]), removed) if removed else (mesh, 0)
