"""Places that touch in space and are far apart on the surface, grown together."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.distance import cdist

from gipkg.surfaces.edge_graph import edge_graph

TRIED = 64
"""Random vertices among which the one is chosen whose way to another is shortened most."""

FAR = 0.4
"""A shortcut joins vertices that are at least so far apart on the surface, as a share of the
largest distance found: more than neighbours even on coarse meshes."""


def add_shortcuts(
    mesh: trimesh.Trimesh, strength: float, rng: np.random.Generator
) -> trimesh.Trimesh:
    """Join pairs of places by tubes; every tube is a handle more.

    Two vertices with their faces are taken away, and what is left open is joined by a band of
    triangles.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed surface.
    strength : float
        Number of shortcuts, rounded.
    rng : numpy.random.Generator
    """
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    for _ in range(round(strength)):
        faces = _join(vertices, faces, *_shortest(vertices, faces, rng))
    return trimesh.Trimesh(vertices, faces, process=False)


def _shortest(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], rng: np.random.Generator
) -> tuple[int, int]:
    """Choose two vertices that are near in space for how far apart they are on the surface."""
    used = np.unique(faces)
    tried = rng.permutation(used)[:TRIED]
    along = dijkstra(edge_graph(vertices, faces), indices=tried)[:, used]
    ratio = cdist(vertices[tried], vertices[used]) / np.maximum(along, FAR * along.max())
    ratio[along < FAR * along.max()] = np.inf
    one, two = np.unravel_index(ratio.argmin(), ratio.shape)
    return int(tried[one]), int(used[two])


def _join(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], one: int, two: int
) -> NDArray[np.int64]:
    """Put a band of triangles in the place of the faces at two vertices."""
    first, second = _link(faces, one), _link(faces, two)[::-1]
    near = cdist(vertices[first], vertices[second])
    i, j = np.unravel_index(near.argmin(), near.shape)
    kept = faces[~np.isin(faces, (one, two)).any(axis=1)]
    return np.concatenate([kept, _band(np.roll(first, -i), np.roll(second, -j))])


def _link(faces: NDArray[np.int64], vertex: int) -> NDArray[np.int64]:
    """Return the vertices around a vertex, in the order in which its faces run past them."""
    star = faces[(faces == vertex).any(axis=1)]
    turned = [np.roll(face, -int(np.flatnonzero(face == vertex)[0])) for face in star]
    following = {int(a): int(b) for _, a, b in turned}
    link = [min(following)]
    while (after := following[link[-1]]) != link[0]:
        link.append(after)
    return np.array(link)


def _band(one: NDArray[np.int64], two: NDArray[np.int64]) -> NDArray[np.int64]:
    """Join two loops, both run through at an even pace, the second against its direction."""
    pace = [(np.arange(len(loop)) + 0.5) / len(loop) for loop in (one, two)]
    ahead = np.argsort(np.concatenate(pace), kind="stable") < len(one)  # on the first loop
    i = (np.cumsum(ahead) - ahead) % len(one)
    j = (np.cumsum(~ahead) - ~ahead) % len(two)
    next_one, next_two = np.roll(one, -1), np.roll(two, -1)
    apex = np.where(ahead, two[j], one[i])
    start, end = np.where(ahead, one[i], next_two[j]), np.where(ahead, next_one[i], two[j])
    return np.column_stack((start, end, apex))
