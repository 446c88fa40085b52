import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from gipkg.parametrizers.hierarchy.canonical import canonical_order
from tests.support.shapes import ellipsoid, icosphere, urchin


def _ordered(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order, renumbered = canonical_order(vertices, faces)
    assert sorted(order) == list(range(len(vertices)))
    same = {tuple(np.roll(face, -face.argmin())) for face in order[renumbered]}
    assert same == {tuple(np.roll(face, -face.argmin())) for face in faces}
    return vertices[order], renumbered


def _bumpy(seed: int) -> trimesh.Trimesh:
    mesh = icosphere(2)
    mesh.vertices *= 1 + 0.1 * np.random.default_rng(seed).normal(size=(len(mesh.vertices), 1))
    return mesh


@given(st.integers(0, 1000))
@settings(deadline=None, max_examples=20)
def test_the_order_survives_renumbering_and_motion(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mesh = _bumpy(seed)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    expected = _ordered(vertices, faces)
    shuffle = rng.permutation(len(vertices))
    renamed = np.argsort(shuffle)[faces][rng.permutation(len(faces))]
    turns = rng.integers(0, 3, len(faces))[:, None]
    renamed = np.take_along_axis(renamed, (turns + np.arange(3)) % 3, axis=1)
    rotation = Rotation.random(rng=rng)
    moved = 7 * rotation.apply(vertices[shuffle]) + 3
    found = _ordered(moved, renamed)
    np.testing.assert_array_equal(found[1], expected[1])
    np.testing.assert_allclose(rotation.inv().apply((found[0] - 3) / 7), expected[0], atol=1e-12)


@pytest.mark.parametrize("mesh", [icosphere(2), ellipsoid(1, 1, 4), urchin(12, 3.0)])
def test_a_symmetric_mesh_is_ordered_up_to_its_symmetries(mesh: trimesh.Trimesh) -> None:
    faces = np.asarray(mesh.faces)
    shuffle = np.random.default_rng(0).permutation(len(mesh.vertices))
    first = _ordered(np.asarray(mesh.vertices), faces)
    second = _ordered(np.asarray(mesh.vertices)[shuffle], np.argsort(shuffle)[faces])
    np.testing.assert_array_equal(first[1], second[1])
    for vertices, renumbered in (first, second):
        edges = vertices[renumbered] - vertices[np.roll(renumbered, -1, axis=1)]
        lengths = np.linalg.norm(edges, axis=2)
        if vertices is first[0]:
            expected = lengths
    np.testing.assert_allclose(lengths, expected, rtol=1e-6)
