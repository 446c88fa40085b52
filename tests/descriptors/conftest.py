"""Closed surfaces that are neither round nor convex."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh


@pytest.fixture(scope="session")
def pebble() -> trimesh.Trimesh:
    """A closed surface of 642 vertices, mirror-symmetric in y and lopsided otherwise."""
    mesh = trimesh.creation.icosphere(3)
    x, y, z = mesh.vertices.T
    radius = 1 + 0.3 * np.sin(3 * x + 0.5) * np.cos(4 * y) + 0.2 * z
    return trimesh.Trimesh(mesh.vertices * radius[:, None] * [1, 1.2, 2], mesh.faces, process=False)


@pytest.fixture(scope="session")
def small_pebble() -> trimesh.Trimesh:
    """The same idea with 162 vertices."""
    mesh = trimesh.creation.icosphere(2)
    x, y, z = mesh.vertices.T
    radius = 1 + 0.2 * np.sin(2 * x + 0.5) * np.cos(3 * y) + 0.2 * z
    return trimesh.Trimesh(mesh.vertices * radius[:, None] * [1, 1.2, 2], mesh.faces, process=False)
