"""Borders of a surface and the caps that close them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import halfedges
from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.caps import Cap, cap
from gipkg.surfaces.triangles import Triangles


def border_loops(faces: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """List the borders of a manifold oriented surface as loops of vertices.

    A loop runs against the faces at it, so that a cap running along it continues the
    surface's orientation; loops are sorted by their least vertex and start there.
    """
    edges = halfedges.group_edges(faces)
    origin, target = halfedges.endpoints(faces)
    border = edges.halfedges(edges.count == 1)
    follower = dict(zip(target[border].tolist(), origin[border].tolist(), strict=True))
    loops = []
    for start in sorted(follower):
        loop = []
        while start in follower:
            loop.append(start)
            start = follower.pop(start)
        if loop:
            loops.append(np.array(loop, np.int64))
    return loops


def fill_holes(mesh: Triangles, largest: float) -> tuple[Triangles, int]:
    """Close every border of a manifold oriented surface by a cap, and count them.

    Parameters
    ----------
    mesh : Triangles
    largest : float
        Largest area of a cap, as a share of the closed surface's.

    Raises
    ------
    UnsupportedMesh
        A hole is larger than that.
    """
    loops = border_loops(mesh.faces)
    caps = [cap(mesh.vertices[loop]) for loop in loops]
    areas = [_cap_area(mesh.vertices[loop], disc) for loop, disc in zip(loops, caps, strict=True)]
    total = float(face_areas(mesh.vertices, mesh.faces).sum()) + sum(areas)
    vertices, faces = [mesh.vertices[:0]], [mesh.faces[:0]]
    size = len(mesh.vertices)
    for loop, disc, added in zip(loops, caps, areas, strict=True):
        if added > largest * total:
            raise UnsupportedMesh(
                f"a hole of {len(loop)} edges would be closed by a cap of {added / total:.0%} of "
                f"the whole surface, more than {largest:.0%}: this is rather an open sheet than "
                "the surface of a solid. largest_hole=1 closes it all the same"
            )
        number = np.concatenate((loop, size + np.arange(len(disc.vertices))))
        vertices.append(disc.vertices)
        faces.append(number[disc.faces])
        size += len(disc.vertices)
    if not loops:
        return mesh, 0
    return mesh.append(np.concatenate(vertices), np.concatenate(faces)), len(loops)


def _cap_area(loop: NDArray[np.float64], disc: Cap) -> float:
    return float(face_areas(np.concatenate((loop, disc.vertices)), disc.faces).sum())


def close_loop(mesh: Triangles, loop: NDArray[np.int64], shift: NDArray[np.float64]) -> Triangles:
    """Cap one border.

    Parameters
    ----------
    mesh : Triangles
    loop : (n,) int array
        As `border_loops` lists it.
    shift : (3,) float64 array
        How far to bulge the cap's middle out of the harmonic position.
    """
    disc = cap(mesh.vertices[loop])
    added = disc.vertices + (1 - disc.radius[:, None] ** 2) * shift
    number = np.concatenate((loop, len(mesh.vertices) + np.arange(len(added))))
    return mesh.append(added, number[disc.faces])
