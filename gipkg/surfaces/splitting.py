"""Non-manifold edges and vertices made manifold by giving each sheet vertices of its own.

At an edge of more than two faces the sheets that continue each other most smoothly stay
joined; what is left over becomes a border. Then every fan of faces gets its own copy of the
vertex (the cutting step of Guéziec, Taubin, Lazarus & Horn, Converting sets of polygons to
manifold surfaces by cutting and stitching, IEEE Visualization 1998).
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces import halfedges
from gipkg.surfaces.halfedges import Ints
from gipkg.surfaces.triangles import Triangles


def split_nonmanifold(mesh: Triangles) -> tuple[Triangles, int]:
    """Make every edge and vertex manifold, and count the vertices this adds."""
    before = len(mesh.vertices)
    while True:
        edges = halfedges.group_edges(mesh.faces)
        chosen = _pair_crowded(mesh, edges)
        mesh, _ = split_fans(mesh, np.concatenate((edges.pairs(), chosen)))
        if not (doubled := _doubled_edges(mesh.faces, chosen)):
            return mesh, len(mesh.vertices) - before
        mesh = _insert_midpoints(mesh, doubled)


def split_fans(mesh: Triangles, pairs: Ints) -> tuple[Triangles, Ints]:
    """Give every fan of faces, as joined across `pairs`, a vertex of its own.

    Parameters
    ----------
    mesh : Triangles
    pairs : (P, 2) int array
        Half-edges across which faces stay joined.

    Returns
    -------
    mesh : Triangles
        The first fan keeps the vertex; the copies follow after the last vertex.
    source : (V + n,) int array
        The vertex that every vertex of the result is or copies.
    """
    count, fan = halfedges.fans(mesh.faces, pairs)
    source_of_fan = np.zeros(count, np.int64)
    source_of_fan[fan] = mesh.faces.ravel()
    _, first = np.unique(source_of_fan, return_index=True)
    extra = np.ones(count, bool)
    extra[first] = False
    vertex = source_of_fan.copy()
    vertex[extra] = len(mesh.vertices) + np.arange(np.count_nonzero(extra))
    source = np.concatenate((np.arange(len(mesh.vertices)), source_of_fan[extra]))
    split = Triangles(mesh.vertices[source], vertex[fan].reshape(-1, 3), mesh.original[source])
    return split, source


def _pair_crowded(mesh: Triangles, edges: halfedges.Edges) -> Ints:
    """Choose (P, 2) half-edges that stay joined at the edges of more than two faces."""
    pairs = [pair for around in edges.crowded() for pair in _smoothest_pairs(mesh, around)]
    return np.array(pairs, np.int64).reshape(-1, 2)


def _smoothest_pairs(mesh: Triangles, around: Ints) -> list[tuple[int, int]]:
    """Pair half-edges of opposite directions around one edge, least bending first."""
    inward = _inward_directions(mesh, around)
    origin = mesh.faces.ravel()[around]
    ranked = sorted(
        (float(inward[i] @ inward[j]), i, j)
        for i, j in combinations(range(len(around)), 2)
        if origin[i] != origin[j]
    )
    free = set(range(len(around)))
    pairs = []
    for _, i, j in ranked:
        if i in free and j in free:
            free -= {i, j}
            pairs.append((int(around[i]), int(around[j])))
    return pairs


def _inward_directions(mesh: Triangles, around: Ints) -> NDArray[np.float64]:
    """Return unit vectors in the faces' planes, perpendicular to their half-edges `around`."""
    corners = mesh.faces.ravel()
    a = mesh.vertices[corners[around]]
    b = mesh.vertices[corners[halfedges.next_halfedge(around)]]
    c = mesh.vertices[corners[halfedges.next_halfedge(halfedges.next_halfedge(around))]]
    along = _unit(b - a)
    across = c - a
    return _unit(across - np.sum(across * along, axis=1, keepdims=True) * along)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def _doubled_edges(faces: Ints, chosen: Ints) -> list[tuple[int, ...]]:
    """List the edges, as tuples of half-edges, that still share both ends with another one."""
    partner = dict(map(tuple, chosen.tolist())) | dict(map(tuple, chosen[:, ::-1].tolist()))
    doubled, used_faces = [], set[int]()
    for around in halfedges.group_edges(faces).crowded():
        instances = {tuple(sorted({h, partner.get(h, h)})) for h in around.tolist()}
        for instance in sorted(instances)[1:]:
            touched = {h // 3 for h in instance}
            if not touched & used_faces:
                used_faces |= touched
                doubled.append(instance)
    return doubled


def _insert_midpoints(mesh: Triangles, chosen: list[tuple[int, ...]]) -> Triangles:
    """Split each of the edges, and the faces at it, at a new vertex in its middle."""
    faces = mesh.faces.copy()
    added_faces: list[tuple[int, int, int]] = []
    middles: list[NDArray[np.float64]] = []
    for instance in chosen:
        middle = len(mesh.vertices) + len(middles)
        for halfedge in instance:
            face, corner = divmod(halfedge, 3)
            a, b, c = np.roll(mesh.faces[face], -corner)
            faces[face] = a, middle, c
            added_faces.append((middle, b, c))
        middles.append((mesh.vertices[a] + mesh.vertices[b]) / 2)
    return Triangles(
        np.concatenate((mesh.vertices, middles)),
        np.concatenate((faces, added_faces)),
        np.concatenate((mesh.original, np.ones(len(middles), bool))),
    )
