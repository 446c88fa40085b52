"""From a dense isosurface to a mesh of its own kind: size, regularity and noise vary."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

Vertices = NDArray[np.float64]
Faces = NDArray[np.int64]

WAVES = 6
WAVE_NUMBER = 6.0
"""Spread of the waves' components, in radians per unit: a skeleton spans one to four."""


def genus(faces: Faces, count: int) -> int | None:
    """Genus of a closed, oriented surface of one component; None of anything else.

    Parameters
    ----------
    faces : (F, 3) array
    count : int
        Number of vertices; all of them are in faces.

    Notes
    -----
    Two corners of faces belong together when the faces share an edge in opposite
    directions. The surface is manifold when the corners of every vertex make one group.
    """
    corners = np.arange(faces.size).reshape(faces.shape)
    tail, head = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    forward, backward = tail * count + head, head * count + tail
    order = np.argsort(forward)
    if (np.diff(forward[order]) == 0).any():
        return None
    place = np.minimum(np.searchsorted(forward[order], backward), len(order) - 1)
    twin = order[place]
    if not np.array_equal(forward[twin], backward):
        return None
    # The tail of an edge is the head of its twin.
    head_corner = np.roll(corners, -1, axis=1).ravel()
    pairs = (corners.ravel(), head_corner[twin])
    fans = coo_array((np.ones(faces.size), pairs), shape=(faces.size, faces.size))
    pieces = connected_components(_adjacency(faces, count), directed=False)[0]
    if pieces != 1 or connected_components(fans, directed=False)[0] != count:
        return None
    return 1 - (count - faces.size // 2 + len(faces)) // 2


def undulate(
    vertices: Vertices, faces: Faces, amplitude: float, rng: np.random.Generator
) -> Vertices:
    """Move the vertices along their normals by a sum of random plane waves.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
    amplitude : float
        Standard deviation of the displacement.
    rng : numpy.random.Generator

    Returns
    -------
    (V, 3) array
    """
    directions = rng.normal(size=(3, WAVES)) * WAVE_NUMBER
    phases = rng.uniform(0.0, 2 * np.pi, WAVES)
    waves = np.sin(vertices @ directions + phases).sum(axis=1) * np.sqrt(2 / WAVES)
    return vertices + amplitude * waves[:, None] * _normals(vertices, faces)


def decimate(vertices: Vertices, faces: Faces, size: int, adaptive: bool) -> tuple[Vertices, Faces]:
    """Collapse edges to `size` vertices without a change of topology.

    Parameters
    ----------
    vertices : (V, 3) array
    faces : (F, 3) array
        Closed surface.
    size : int
        Vertices to keep.
    adaptive : bool
        Collapse where the surface is flat (quadric error metric, Garland & Heckbert,
        Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997) rather than
        where edges are short.

    Returns
    -------
    vertices : (size, 3) array
    faces : (F', 3) array
    """
    import igl

    removed = 2 * (len(vertices) - size)
    collapse = igl.qslim if adaptive else igl.decimate
    vertices, faces, *_ = collapse(vertices, faces, max_m=len(faces) - removed)
    return np.ascontiguousarray(vertices), np.ascontiguousarray(faces)


def relax(vertices: Vertices, faces: Faces, rounds: int) -> Vertices:
    """Make the triangles more regular: move vertices to their neighbours' mean, tangentially."""
    adjacency = _adjacency(faces, len(vertices))
    degree = adjacency.sum(axis=1)[:, None]
    for _ in range(rounds):
        normals = _normals(vertices, faces)
        step = adjacency @ vertices / degree - vertices
        vertices = vertices + 0.5 * (step - (step * normals).sum(1, keepdims=True) * normals)
    return vertices


def jitter(vertices: Vertices, faces: Faces, strength: float, rng: np.random.Generator) -> Vertices:
    """Displace every vertex by Gaussian noise of `strength` times the mean edge length."""
    edges = vertices[faces] - vertices[np.roll(faces, -1, axis=1)]
    length = np.linalg.norm(edges, axis=2).mean()
    return vertices + rng.normal(scale=strength * length, size=vertices.shape)


def _adjacency(faces: Faces, count: int) -> csr_array:
    pairs = (faces.ravel(), np.roll(faces, -1, axis=1).ravel())
    return coo_array((np.ones(faces.size), pairs), shape=(count, count)).tocsr()


def _normals(vertices: Vertices, faces: Faces) -> Vertices:
    """(V, 3) unit vertex normals, weighted by area; zero where they cancel."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    weighted = np.cross(b - a, c - a)
    normals = np.stack(
        [
            np.bincount(faces.ravel(), np.repeat(weighted[:, axis], 3), len(vertices))
            for axis in range(3)
        ],
        axis=1,
    )
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(lengths > 0, lengths, 1.0)
