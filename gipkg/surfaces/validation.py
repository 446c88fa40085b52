"""The one check that every method on closed genus-0 surfaces runs first."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.errors import UnsupportedMesh
from gipkg.formats.array_faults import array_fault
from gipkg.surfaces import halfedges
from gipkg.surfaces.areas import face_areas

DEGENERATE = 1e-12
"""A face at or below this share of the mean face area counts as degenerate."""


def check_genus_zero(mesh: trimesh.Trimesh) -> None:
    """Accept a closed, oriented, manifold genus-0 surface of one component, or say why not.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        V vertices and F faces; never changed.

    Raises
    ------
    UnsupportedMesh
        The message names every fault that was found and the way out.
    """
    faults = list(genus_zero_faults(np.asarray(mesh.vertices), np.asarray(mesh.faces)))
    if faults:
        name = mesh.metadata.get("file_name") or "the mesh"
        raise UnsupportedMesh(
            f"{name} is not a closed genus-0 surface: {'; '.join(faults)}. "
            "gipkg.prepare(mesh).mesh repairs what can be repaired"
        )


def genus_zero_faults(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> Iterator[str]:
    """Name what keeps (V, 3) vertices and (F, 3) faces from being a closed genus-0 surface.

    Faults that would make the later questions meaningless end the search.
    """
    fault = array_fault(vertices, faces)
    if fault:
        yield fault
        return
    if unused := len(vertices) - np.count_nonzero(np.bincount(faces.ravel())):
        yield f"{unused} vertices belong to no face"
    if repeated := np.count_nonzero(repeats_vertex(faces)):
        yield f"{repeated} faces name a vertex twice"
        return
    if degenerate := np.count_nonzero(degenerate_faces(vertices, faces)):
        yield f"{degenerate} faces have no area"
    edges = halfedges.group_edges(faces)
    edge_faults = list(_edge_faults(edges))
    yield from edge_faults
    if not edge_faults:
        yield from _global_faults(faces, edges.pairs())


def repeats_vertex(faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Mark the (F,) faces that name a vertex more than once."""
    return (faces == np.roll(faces, 1, axis=1)).any(axis=1)


def degenerate_faces(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Mark the (F,) faces whose area is nothing beside the mean (see `DEGENERATE`)."""
    area = face_areas(vertices, faces)
    return area <= DEGENERATE * area.mean()


def _edge_faults(edges: halfedges.Edges) -> Iterator[str]:
    if border := np.count_nonzero(edges.count == 1):
        yield f"it is open: {border} edges belong to one face only"
    if crowded := np.count_nonzero(edges.count > 2):
        yield f"{crowded} edges belong to more than two faces"
    if opposed := np.count_nonzero((edges.count == 2) & (edges.balance != 0)):
        yield f"the two faces at {opposed} edges are oriented against each other"


def _global_faults(faces: NDArray[np.int64], pairs: NDArray[np.int64]) -> Iterator[str]:
    """Name the faults of a surface whose edges all join two faces of one orientation."""
    used = np.count_nonzero(np.bincount(faces.ravel()))
    fan_count, _ = halfedges.fans(faces, pairs)
    if fan_count > used:
        yield f"{fan_count - used} vertices pinch the surface (their faces form several fans)"
    component_count, _ = halfedges.components(faces, pairs)
    if component_count > 1:
        yield f"it has {component_count} components"
    # With pinched vertices counted once a fan, V - E + F = 2 (components - genus), E = 3F/2.
    genus = component_count - (fan_count - len(faces) // 2) // 2
    if genus:
        yield f"its genus is {genus}, not 0"
