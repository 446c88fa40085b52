from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from gipkg.baselines.light_field.baseline import LightField
from gipkg.descriptors.operators import Operators
from gipkg.testing import meshes


def represent(mesh: trimesh.Trimesh) -> np.ndarray:
    return LightField().represent(mesh, Operators(mesh))


@pytest.fixture(scope="module")
def limbed() -> np.ndarray:
    return represent(meshes.limbed())


def test_all_views_of_a_ball_are_one() -> None:
    views = represent(trimesh.creation.icosphere(3)).reshape(100, -1)
    assert np.ptp(views, axis=0).max() < 0.05


def test_a_shift_and_a_size_change_nothing(limbed) -> None:
    mesh = meshes.limbed()
    moved = meshes.mesh_of(mesh.vertices * 40 + [3.0, -80.0, 5.0], mesh.faces)
    assert_allclose(represent(moved), limbed, atol=1e-4)


def test_turned_shapes_are_nearer_than_others_and_alike_as_vectors(limbed) -> None:
    turns = {
        f"turn {seed}": represent(meshes.moved(meshes.limbed(), np.random.default_rng(seed)))
        for seed in range(3)
    }
    long = represent(meshes.ellipsoid())
    flat = represent(meshes.ellipsoid((1.0, 1.0, 0.3)))
    shapes = {**turns, "limbed": limbed, "long": long, "flat": flat}
    test = (*turns, "long", "flat")
    found = LightField().predict(shapes, {"limbed": "a", "long": "b", "flat": "c"}, test)
    assert [found.classes[k] for k in found.scores.argmax(axis=1)] == [*"aaa", "b", "c"]
    among, across = found.distances[:3, :3], found.distances[:3, 3:]
    assert among.max() < 0.2 * across.min()
    vectors = found.embeddings.astype(float)
    apart = np.linalg.norm(vectors[:3] - vectors[0], axis=1)
    assert apart.max() < 0.1 * np.linalg.norm(vectors[0] - vectors[3])


def test_the_vector_of_all_views_is_as_long_as_in_the_paper(limbed) -> None:
    shapes = {str(n): limbed * factor for n, factor in enumerate((1.0, 0.9, 0.5, 0.4))}
    train = {"0": "a", "2": "b"}
    found = LightField(vector="concatenated").predict(shapes, train, ("1", "3"))
    assert found.embeddings.shape == (2, 4700)
    assert found.scores.argmax(axis=1).tolist() == [0, 1]
