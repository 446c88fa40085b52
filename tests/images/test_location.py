"""Point location: every direction in a face that contains it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from gipkg.images.location import locate


def random_directions(rng: np.random.Generator, count: int) -> np.ndarray:
    directions = rng.standard_normal((count, 3))
    directions[: count // 2] = [0, 0, 1] + 1e-3 * directions[: count // 2]
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6), vertices=st.sampled_from([8, 40, 400]))
def test_the_weighted_corners_point_in_the_direction(star_map, seed, vertices) -> None:
    """With weights in [0, 1] and an outward face, this proves that the face contains it."""
    spherical_map = star_map(seed, vertices)
    sphere, faces = spherical_map.sphere, np.asarray(spherical_map.mesh.faces)
    directions = random_directions(np.random.default_rng([seed, 1]), 2_000)
    face, weights, uncovered = locate(sphere, faces, directions, 50)
    assert uncovered == -1
    assert weights.min() >= 0
    assert_allclose(weights.sum(axis=1), 1, atol=1e-15)
    corners = sphere[faces[face]]
    points = np.einsum("ni,nij->nj", weights, corners)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    assert_allclose(points, directions, atol=2e-15)
    assert (np.linalg.det(corners) > 0).all()


def test_vertices_and_edge_midpoints_are_found_on_their_faces(star_map) -> None:
    spherical_map = star_map(3, 200)
    sphere, faces = spherical_map.sphere, np.asarray(spherical_map.mesh.faces)
    face, weights, _ = locate(sphere, faces, sphere, 10)
    at_corner = (faces[face] == np.arange(len(sphere))[:, None]) & (weights == 1)
    assert at_corner.any(axis=1).all()
    edges = spherical_map.mesh.edges_unique
    middles = sphere[edges].sum(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    face, weights, _ = locate(sphere, faces, middles, 10)
    point = np.einsum("ni,nij->nj", weights, sphere[faces[face]])
    assert_allclose(point / np.linalg.norm(point, axis=1, keepdims=True), middles, atol=1e-15)


def test_the_start_of_the_walk_does_not_matter(star_map) -> None:
    spherical_map = star_map(4, 300)
    sphere, faces = spherical_map.sphere, np.asarray(spherical_map.mesh.faces)
    rng = np.random.default_rng(40)
    directions = random_directions(rng, 1_000)
    order = rng.permutation(1_000)
    face, weights, _ = locate(sphere, faces, directions, 1_000)
    shuffled, shuffled_weights, _ = locate(sphere, faces, directions[order], 7)
    assert (shuffled == face[order]).all()
    assert (shuffled_weights == weights[order]).all()


def test_a_fold_is_covered_by_its_outward_faces(sphere_map) -> None:
    """Pull one vertex over its ring: faces flip, yet every direction keeps an outward face."""
    sphere, faces = sphere_map.sphere.copy(), np.asarray(sphere_map.mesh.faces)
    vertex = 100
    ring = np.unique(faces[(faces == vertex).any(axis=1)])
    far = ring[ring != vertex][0]
    sphere[vertex] = 2.5 * sphere[far] - 1.5 * sphere[vertex]
    sphere[vertex] /= np.linalg.norm(sphere[vertex])
    assert (np.linalg.det(sphere[faces]) < 0).any()
    around = sphere_map.sphere[vertex] + 0.1 * np.random.default_rng(0).standard_normal((4_000, 3))
    around /= np.linalg.norm(around, axis=1, keepdims=True)
    face, weights, uncovered = locate(sphere, faces, around, 100)
    assert uncovered == -1
    points = np.einsum("ni,nij->nj", weights, sphere[faces[face]])
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    assert_allclose(points, around, atol=1e-14)
    assert (np.linalg.det(sphere[faces[face]]) > 0).all()


@pytest.mark.parametrize("defect", ["mirrored", "hemisphere", "nan"])
def test_an_uncovered_direction_is_reported(sphere_map, defect: str) -> None:
    sphere, faces = sphere_map.sphere.copy(), np.asarray(sphere_map.mesh.faces)
    if defect == "mirrored":
        sphere[:, 0] *= -1
    elif defect == "hemisphere":
        sphere[:, 2] = np.abs(sphere[:, 2])
    else:
        sphere[:] = np.nan
    directions = np.array([[0.1, 0.2, 1], [0.3, -0.4, -1]])
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    _, _, uncovered = locate(sphere, faces, directions, 2)
    assert uncovered == (1 if defect == "hemisphere" else 0)
