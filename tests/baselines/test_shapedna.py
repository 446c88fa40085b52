from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from gipkg.baselines.shapedna import ShapeDNA
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh


def test_the_sphere_has_its_known_spectrum() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=4)
    found = ShapeDNA(eigenvalues=24).represent(mesh, Operators(mesh))
    degrees = np.repeat([1, 2, 3, 4], [3, 5, 7, 9])
    np.testing.assert_allclose(found, np.log(4 * np.pi * degrees * (degrees + 1)), atol=0.01)


def test_motion_and_size_change_nothing() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=2)
    mesh.vertices *= [1.0, 1.5, 0.6]
    moved = mesh.copy()
    moved.vertices = 1e3 * Rotation.random(rng=1).apply(moved.vertices) + 5.0
    dna = ShapeDNA()
    np.testing.assert_allclose(
        dna.represent(moved, Operators(moved)), dna.represent(mesh, Operators(mesh)), rtol=1e-8
    )


def test_a_mesh_too_coarse_is_refused() -> None:
    mesh = trimesh.creation.icosahedron()
    with pytest.raises(UnsupportedMesh, match="too few"):
        ShapeDNA(eigenvalues=30).represent(mesh, Operators(mesh))


def test_a_surface_of_two_parts_is_refused() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    pair = trimesh.util.concatenate([ball, ball.copy().apply_translation([5, 0, 0])])
    with pytest.raises(UnsupportedMesh, match="not connected"):
        ShapeDNA().represent(pair, Operators(pair))
