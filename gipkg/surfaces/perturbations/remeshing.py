"""The same surface under other triangles."""

from __future__ import annotations

import math

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.surfaces.decimation import decimate
from gipkg.surfaces.triangles import Triangles

NEAREST = 0.3
"""An edge is split between this share of its length and the other end's."""


def remesh(mesh: trimesh.Trimesh, strength: float, rng: np.random.Generator) -> trimesh.Trimesh:
    """Split all edges at random points until there are too many vertices, then collapse.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed surface of V vertices.
    strength : float
        Vertices of the result, as a multiple of V.
    rng : numpy.random.Generator
    """
    vertices, faces = np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int64)
    wanted = max(4, math.ceil(strength * len(vertices)))
    while True:
        vertices, faces = _split_edges(vertices, faces, rng)
        if len(vertices) >= 2 * wanted:
            break
    dense = Triangles(vertices, faces, np.ones(len(vertices), bool))
    coarse = decimate(dense, wanted)
    return trimesh.Trimesh(coarse.vertices, coarse.faces, process=False)


def _split_edges(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], rng: np.random.Generator
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Put a vertex into every edge and make each face four; the surface is the same."""
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1), axis=-1)
    edges, number = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    share = rng.uniform(NEAREST, 1 - NEAREST, (len(edges), 1))
    added = (1 - share) * vertices[edges[:, 0]] + share * vertices[edges[:, 1]]
    a, b, c = faces.T
    ab, bc, ca = (len(vertices) + number.reshape(-1, 3)).T
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    split = np.concatenate([np.column_stack(quarter) for quarter in quarters])
    return np.concatenate([vertices, added]), split
