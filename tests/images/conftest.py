"""Bijective maps without a parametrizer: star-shaped surfaces, projected from within."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from gipkg.api import SphericalMap

StarMap = Callable[[int, int], SphericalMap]


@pytest.fixture(scope="session")
def star_map() -> StarMap:
    """Surface of random radii over random directions, a quarter of them in a tight cluster."""

    def make(seed: int, vertices: int) -> SphericalMap:
        rng = np.random.default_rng(seed)
        directions = rng.standard_normal((vertices, 3))
        directions[: vertices // 4] = [0, 0, 1] + 1e-3 * directions[: vertices // 4]
        directions[-6:] = np.concatenate([np.eye(3), -np.eye(3)])  # the centre is within
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        faces = ConvexHull(directions).simplices
        a, b, c = (directions[faces[:, k]] for k in range(3))
        inward = np.einsum("ij,ij->i", a, np.cross(b - a, c - a)) < 0
        faces[inward] = faces[inward][:, ::-1]
        radii = np.exp(0.3 * rng.standard_normal(vertices))
        mesh = trimesh.Trimesh(directions * radii[:, None], faces, process=False)
        return SphericalMap(mesh, directions)

    return make


@pytest.fixture(scope="session")
def sphere_map() -> SphericalMap:
    """A unit sphere of 2,562 vertices under the identity."""
    mesh = trimesh.creation.icosphere(4)
    return SphericalMap(mesh, np.asarray(mesh.vertices))
