"""An order of a mesh's vertices and faces that depends on its geometry alone.

All decisions on the way to a map, from the first collapse on, may hang on the order of vertices
or on the last bit of a length. A mesh whose vertices are permuted, or that is moved, would then get
another map, as good but not the same. Here vertices are numbered breadth-first from a flag (a
half-edge and its left face) which is chosen by lengths of edges rounded to single precision: far
above the round-off of a motion, far below what tells two edges apart.

Only a mesh with symmetries has several such flags; they lead to the same map up to the symmetry.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces.edge_collapse import following, preceding
from gipkg.surfaces.halfedges import endpoints, twins


def canonical_order(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Order a closed oriented mesh of one component by its geometry.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array

    Returns
    -------
    order : (V,) int64 array
        The vertices in canonical order.
    renumbered : (F, 3) int64 array
        The faces in canonical order; entry i stands for vertex ``order[i]``.
    """
    origin, target = endpoints(faces)
    twin = twins(faces)
    lengths = np.linalg.norm(vertices[target] - vertices[origin], axis=1)
    # Both half-edges of an edge get the same bits, and the scale of the mesh plays no part.
    lengths = np.minimum(lengths, lengths[twin])
    rounded = (lengths / lengths.mean()).astype(np.float32)
    candidates = np.flatnonzero(rounded == rounded.max())
    rank = _number(_best_flag(candidates, twin, origin, rounded), twin, origin, len(vertices))
    renumbered = rank[faces]
    first = renumbered.argmin(axis=1)
    renumbered = renumbered[np.arange(len(faces))[:, None], (first[:, None] + np.arange(3)) % 3]
    order = np.empty(len(vertices), np.int64)
    order[rank] = np.arange(len(vertices))
    return order, renumbered[np.lexsort(renumbered.T[::-1])]


@compiled
def _number(start, twin, origin, count):  # type: ignore[no-untyped-def]
    """Give every vertex its place in a traversal, breadth-first and counterclockwise."""
    rank = np.full(count, -1, np.int64)
    entry = np.zeros(count, np.int64)
    rank[origin[start]], entry[0], found = 0, start, 1
    for i in range(count):
        h = entry[i]
        while True:
            tip = origin[following(h)]
            if rank[tip] < 0:
                rank[tip], entry[found] = found, twin[h]
                found += 1
            h = twin[preceding(h)]
            if h == entry[i]:
                break
    return rank


@compiled
def _best_flag(candidates, twin, origin, lengths):  # type: ignore[no-untyped-def]
    """Half-edge whose traversal meets the least sequence of new vertices and lengths."""
    count = 0
    for h in range(len(origin)):
        count = max(count, origin[h] + 1)
    best = candidates[0]
    ranks = np.full((2, count), -1, np.int64)
    entries = np.zeros((2, count), np.int64)
    for c in range(1, len(candidates)):
        flags = (best, candidates[c])
        found = np.ones(2, np.int64)
        for s in range(2):
            ranks[s, origin[flags[s]]] = 0
            entries[s, 0] = flags[s]
        order, i = 0, 0
        while order == 0 and i < count:
            order = _compare_rings(i, ranks, entries, found, twin, origin, lengths)
            i += 1
        for s in range(2):
            for k in range(found[s]):
                ranks[s, origin[entries[s, k]]] = -1
        if order > 0:
            best = candidates[c]
    return best


@compiled
def _compare_rings(i, ranks, entries, found, twin, origin, lengths):  # type: ignore[no-untyped-def]
    """Go around the i-th vertex of both traversals; the sign of the first difference, or 0."""
    h0, h1 = entries[0, i], entries[1, i]
    while True:
        if lengths[h0] != lengths[h1]:
            return 1 if lengths[h0] > lengths[h1] else -1
        tip0, tip1 = origin[following(h0)], origin[following(h1)]
        rank0, rank1 = ranks[0, tip0], ranks[1, tip1]
        if rank0 != rank1:
            return 1 if rank0 > rank1 else -1
        if rank0 < 0:
            ranks[0, tip0], entries[0, found[0]] = found[0], twin[h0]
            ranks[1, tip1], entries[1, found[1]] = found[1], twin[h1]
            found[0] += 1
            found[1] += 1
        h0, h1 = twin[preceding(h0)], twin[preceding(h1)]
        if h0 == entries[0, i] or h1 == entries[1, i]:
            if h0 == entries[0, i] and h1 == entries[1, i]:
                return 0
            return 1 if h0 == entries[0, i] else -1
