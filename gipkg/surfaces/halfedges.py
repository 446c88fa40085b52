"""Edges, fans and components of a triangle array, whatever its defects.

Half-edge ``3 f + k`` runs from ``faces[f, k]`` to ``faces[f, (k + 1) % 3]``; corner
``3 f + k`` is the face's angle at ``faces[f, k]``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Ints = NDArray[np.int64]


def next_halfedge(halfedge: Ints) -> Ints:
    """Return the half-edge that follows within the same face."""
    return halfedge + 1 - 3 * (halfedge % 3 == 2)


def endpoints(faces: Ints) -> tuple[Ints, Ints]:
    """Return the origin and the target vertex of the 3F half-edges."""
    return faces.ravel(), np.roll(faces, -1, axis=1).ravel()


def corners_by_vertex(faces: Ints, count: int) -> tuple[Ints, Ints]:
    """Group the corners of (F, 3) faces by the vertex, of `count` = V, that they are at.

    Returns
    -------
    start : (V + 1,) int array
        Vertex v has ``corners[start[v]:start[v + 1]]``.
    corners : (3F,) int array
        Those of a vertex in ascending order.
    """
    numbers = np.bincount(faces.ravel(), minlength=count)
    return np.concatenate(([0], np.cumsum(numbers))), np.argsort(faces.ravel(), kind="stable")


@dataclass(frozen=True, slots=True)
class Edges:
    """The E undirected edges of a triangle array.

    Attributes
    ----------
    order : (3F,) int array
        Half-edges, those of one edge side by side.
    start : (E,) int array
        Where each edge begins in `order`.
    count : (E,) int array
        Number of faces at each edge.
    balance : (E,) int array
        Traversals towards the higher vertex less those towards the lower one: 0 where two
        faces agree in orientation.
    """

    order: Ints
    start: Ints
    count: Ints
    balance: Ints

    def pairs(self) -> Ints:
        """Return the (P, 2) half-edges of all edges with exactly two faces."""
        first = self.start[self.count == 2]
        return np.column_stack((self.order[first], self.order[first + 1]))

    def crowded(self) -> list[Ints]:
        """List the half-edges of every edge of more than two faces."""
        many = self.count > 2
        spans = zip(self.start[many], self.count[many], strict=True)
        return [self.order[begin : begin + count] for begin, count in spans]

    def halfedges(self, chosen: NDArray[np.bool_]) -> Ints:
        """Return all half-edges of the edges that `chosen` (E,) marks."""
        return self.order[np.repeat(chosen, self.count)]


def group_edges(faces: Ints) -> Edges:
    """Group the half-edges of (F, 3) faces by the undirected edge they run along."""
    origin, target = endpoints(faces)
    width = int(faces.max(initial=0)) + 1
    key = np.minimum(origin, target) * width + np.maximum(origin, target)
    order = np.argsort(key, kind="stable")
    key = key[order]
    start = np.flatnonzero(np.r_[True, key[1:] != key[:-1]]) if len(key) else order
    count = np.diff(np.r_[start, len(key)])
    sign = np.where(origin < target, 1, -1)[order]
    balance = np.add.reduceat(sign, start) if len(key) else order
    return Edges(order, start, count, balance)


def twins(faces: Ints) -> Ints:
    """Return the (3F,) opposite half-edges, -1 at the boundary, of an edge-manifold surface."""
    twin = np.full(3 * len(faces), -1)
    first, second = group_edges(faces).pairs().T
    twin[first], twin[second] = second, first
    return twin


def fans(faces: Ints, pairs: Ints) -> tuple[int, Ints]:
    """Count and label the fans of faces around vertices.

    Parameters
    ----------
    faces : (F, 3) int array
    pairs : (P, 2) int array
        Half-edges across which two faces are joined.

    Returns
    -------
    count : int
        Number of fans; equals the number of used vertices where all vertices are manifold.
    label : (3F,) int array
        Fan of every corner, numbered by first appearance.
    """
    origin, _ = endpoints(faces)
    one, two = pairs.T
    one_end, two_end = next_halfedge(one), next_halfedge(two)
    agree = origin[one] != origin[two]
    rows = np.concatenate((one, one_end))
    columns = np.concatenate((np.where(agree, two_end, two), np.where(agree, two, two_end)))
    return label_connected(3 * len(faces), rows, columns)


def components(faces: Ints, pairs: Ints) -> tuple[int, Ints]:
    """Count and label the parts of a surface joined across `pairs`: a number and (F,) ints."""
    one, two = pairs.T
    return label_connected(len(faces), one // 3, two // 3)


def label_connected(size: int, one: Ints, two: Ints) -> tuple[int, Ints]:
    """Count and label the connected sets of `size` things, `one` (P,) joined to `two` (P,)."""
    graph = coo_array((np.ones(len(one), bool), (one, two)), shape=(size, size))
    count, label = connected_components(graph, directed=False)
    return int(count), label
