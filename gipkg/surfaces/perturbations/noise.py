"""Noise of a scanner: every vertex displaced by itself."""

from __future__ import annotations

import numpy as np
import trimesh


def add_noise(mesh: trimesh.Trimesh, strength: float, rng: np.random.Generator) -> trimesh.Trimesh:
    """Displace every vertex at random.

    Parameters
    ----------
    mesh : trimesh.Trimesh
    strength : float
        Standard deviation of each coordinate of the displacement, in mean edge lengths.
    rng : numpy.random.Generator
    """
    vertices = np.asarray(mesh.vertices)
    scale = strength * mesh.edges_unique_length.mean()
    noisy = vertices + scale * rng.standard_normal(vertices.shape)
    return trimesh.Trimesh(noisy, mesh.faces, process=False)
