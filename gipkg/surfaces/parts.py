"""The largest part of a surface, on one orientation."""

from __future__ import annotations

import numpy as np

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import halfedges
from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.triangles import Triangles

THINNEST = 1e-6
"""Least enclosed volume, over area to the power 3/2 (a sphere: 0.09; a sheet of paper: 1e-4)."""

FLAT = 1e-12
"""The same for a surface that was closed when it was given: round-off."""


def largest_part(mesh: Triangles) -> tuple[Triangles, int, float]:
    """Keep the connected part of the largest area.

    Returns
    -------
    mesh : Triangles
    dropped : int
        Number of parts left out.
    share : float
        Area of the part that was kept, of the whole.
    """
    count, part = halfedges.components(mesh.faces, halfedges.group_edges(mesh.faces).pairs())
    if count == 1:
        return mesh, 0, 1.0
    area = np.bincount(part, face_areas(mesh.vertices, mesh.faces))
    best = int(np.argmax(area))
    kept = mesh.with_faces(mesh.faces[part == best]).compact()
    return kept, count - 1, float(area[best] / area.sum())


def orient_consistently(mesh: Triangles) -> tuple[Triangles, int]:
    """Turn the faces that run against most of the area of their part, and count them.

    Every face has two copies, as it is and turned; copies that agree across an edge are
    joined. A part is orientable where a face's two copies are not joined to each other.

    Raises
    ------
    UnsupportedMesh
        The surface has one side only.
    """
    faces, size = mesh.faces, len(mesh.faces)
    origin, _ = halfedges.endpoints(faces)
    one, two = halfedges.group_edges(faces).pairs().T
    opposed = (origin[one] == origin[two]) * size
    rows = np.concatenate((one // 3, one // 3 + size))
    columns = np.concatenate((two // 3 + opposed, two // 3 + size - opposed))
    _, label = halfedges.label_connected(2 * size, rows, columns)
    kept, turned = label[:size], label[size:]
    if (kept == turned).any():
        raise UnsupportedMesh(
            "the surface has one side only (like a Möbius strip), so it bounds no solid. Cut it, "
            "or make the orientation of its faces agree, before preparing it"
        )
    area = np.bincount(kept, face_areas(mesh.vertices, faces), minlength=label.max() + 1)
    turn = (area[turned] > area[kept]) | ((area[turned] == area[kept]) & (turned < kept))
    if not turn.any():
        return mesh, 0
    return mesh.with_faces(np.where(turn[:, None], faces[:, ::-1], faces)), int(turn.sum())


def require_area(mesh: Triangles) -> None:
    """Accept a mesh of which at least one face has an area.

    Raises
    ------
    UnsupportedMesh
        None has.
    """
    if not face_areas(mesh.vertices, mesh.faces).any():
        raise UnsupportedMesh("its faces have no area at all. Export it again from its source")


def require_volume(mesh: Triangles, least: float) -> None:
    """Accept a closed surface that bounds a solid.

    Parameters
    ----------
    mesh : Triangles
    least : float
        Its volume, over area to the power 3/2.

    Raises
    ------
    UnsupportedMesh
        It is folded flat and encloses nothing.
    """
    area = face_areas(mesh.vertices, mesh.faces).sum()
    if abs(enclosed_volume(mesh)) < least * area**1.5:
        raise UnsupportedMesh(
            "it is a folded sheet that encloses no volume, so it bounds no solid. "
            "Give the sheet thickness before preparing it"
        )


def orient_outward(mesh: Triangles) -> tuple[Triangles, int]:
    """Turn all faces of a closed surface whose enclosed volume is negative, and count them."""
    if enclosed_volume(mesh) >= 0:
        return mesh, 0
    return mesh.with_faces(mesh.faces[:, ::-1]), len(mesh.faces)


def enclosed_volume(mesh: Triangles) -> float:
    """Return the signed volume inside a closed oriented surface (divergence theorem)."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] - mesh.vertices.mean(axis=0) for k in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6)
