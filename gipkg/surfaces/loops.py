"""Shortest loops of edges that do not separate a closed surface.

For one base vertex: grow the tree of shortest paths; an edge outside the tree closes a loop
through the base, and that loop does not separate the surface exactly where the edge's dual
is no bridge of the dual graph of all edges outside the tree. Of these, the shortest is the
one that closes the last cycle when dual edges are added longest first (Erickson & Whittlesey,
Greedy optimal homotopy and homology generators, SODA 2005).
"""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces import halfedges

ALL_BASES = 1500
"""Up to this many vertices every one is a base, and the loop found is the shortest there is."""

SAMPLED_BASES = 300
"""Bases of a larger mesh, far from each other; the loop found is then tightened."""

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


def shortest_nonseparating_loop(vertices: Floats, faces: Ints) -> Ints:
    """Find a shortest loop that does not separate a closed surface of genus 1 or more.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array
        Closed, manifold and of one component.

    Returns
    -------
    (n,) int64 array
        The loop's vertices in order.
    """
    pairs = halfedges.group_edges(faces).pairs()
    origin, target = halfedges.endpoints(faces)
    ends = np.column_stack((origin[pairs[:, 0]], target[pairs[:, 0]]))
    length = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    graph = _adjacency(ends, len(vertices))
    best, bound = np.zeros(0, np.int64), np.inf
    bases = _bases(vertices)
    while len(bases):
        loop, found = _best_over_bases(bases, bound, ends, pairs // 3, length, *graph)
        improved = found < bound
        best, bound = (loop, found) if improved else (best, bound)
        bases = best if improved and len(vertices) > ALL_BASES else best[:0]
    return best


def _bases(vertices: Floats) -> Ints:
    """Choose all vertices, or a sample by farthest points."""
    if len(vertices) <= ALL_BASES:
        return np.arange(len(vertices))
    chosen = np.zeros(SAMPLED_BASES, np.int64)
    distance = np.full(len(vertices), np.inf)
    for k in range(1, SAMPLED_BASES):
        step = np.sum((vertices - vertices[chosen[k - 1]]) ** 2, axis=1)
        distance = np.minimum(distance, step)
        chosen[k] = np.argmax(distance)
    return chosen


def _adjacency(ends: Ints, size: int) -> tuple[Ints, Ints]:
    """Return row starts (V + 1,) and the edges (2E,) at every vertex."""
    start = np.concatenate(([0], np.cumsum(np.bincount(ends.ravel(), minlength=size))))
    at_vertex = np.argsort(ends.ravel(), kind="stable") // 2
    return start, at_vertex


@compiled
def _best_over_bases(
    bases: Ints, bound: float, ends: Ints, sides: Ints, length: Floats, start: Ints, at_vertex: Ints
) -> tuple[Ints, float]:
    """Return the shortest loop below `bound` through any of the bases, and its length."""
    size = len(start) - 1
    best = np.zeros(0, np.int64)
    distance = np.full(size, np.inf)
    parent = np.full(size, -1)
    for base in bases:
        reached = _grow_tree(base, bound / 2, ends, length, start, at_vertex, distance, parent)
        for edge in _closing_edges(bound, ends, sides, length, distance, parent):
            loop = _loop_of(edge, ends, parent)
            total = _loop_length(edge, loop, ends, length, distance)
            if total < bound:
                best, bound = loop, total
        for vertex in reached:
            distance[vertex] = np.inf
            parent[vertex] = -1
    return best, bound


@compiled
def _grow_tree(
    base: int,
    reach: float,
    ends: Ints,
    length: Floats,
    start: Ints,
    at_vertex: Ints,
    distance: Floats,
    parent: Ints,
) -> list[int]:
    """Fill in distances and parent edges up to `reach` from the base (Dijkstra's algorithm)."""
    distance[base] = 0.0
    heap = [(0.0, base)]
    reached = [base]
    while heap:
        near, vertex = heapq.heappop(heap)
        if near > distance[vertex]:
            continue
        for edge in at_vertex[start[vertex] : start[vertex + 1]]:
            other = ends[edge, 0] + ends[edge, 1] - vertex
            far = near + length[edge]
            if far < distance[other] and far <= reach:
                if distance[other] == np.inf:
                    reached.append(other)
                distance[other] = far
                parent[other] = edge
                heapq.heappush(heap, (far, other))
    return reached


@compiled
def _closing_edges(
    bound: float, ends: Ints, sides: Ints, length: Floats, distance: Floats, parent: Ints
) -> list[int]:
    """List the edges that close a non-separating loop with the tree, the shortest loop last."""
    root = np.arange(sides.max() + 1)
    candidates = [0 for _ in range(0)]
    for edge in range(len(ends)):
        a, b = ends[edge]
        if parent[a] == edge or parent[b] == edge:
            continue
        if distance[a] + distance[b] + length[edge] < bound:
            candidates.append(edge)
        else:
            _join(root, sides[edge, 0], sides[edge, 1])
    edges = np.array(candidates, np.int64)
    through = distance[ends[edges, 0]] + distance[ends[edges, 1]] + length[edges]
    return [
        edge
        for edge in edges[np.argsort(-through, kind="mergesort")]
        if not _join(root, sides[edge, 0], sides[edge, 1])
    ]


@compiled
def _join(root: Ints, one: int, two: int) -> bool:
    """Join two sets of a union-find forest; False where they were one already."""
    while root[one] != one:
        root[one] = root[root[one]]
        one = root[one]
    while root[two] != two:
        root[two] = root[root[two]]
        two = root[two]
    if one == two:
        return False
    root[max(one, two)] = min(one, two)
    return True


@compiled
def _loop_of(edge: int, ends: Ints, parent: Ints) -> Ints:
    """Return the loop's vertices from the two tree paths, without the way they share."""
    left, right = [ends[edge, 0]], [ends[edge, 1]]
    for path in (left, right):
        while parent[path[-1]] >= 0:
            up = parent[path[-1]]
            path.append(ends[up, 0] + ends[up, 1] - path[-1])
    while len(left) > 1 and len(right) > 1 and left[-2] == right[-2]:
        left.pop()
        right.pop()
    return np.array(left + right[:-1][::-1], np.int64)


@compiled
def _loop_length(edge: int, loop: Ints, ends: Ints, length: Floats, distance: Floats) -> float:
    """Length of the closing edge and of both paths up to where they meet."""
    a, b = ends[edge]
    meeting = np.min(distance[loop])
    return float(distance[a] + distance[b] + length[edge] - 2 * meeting)
