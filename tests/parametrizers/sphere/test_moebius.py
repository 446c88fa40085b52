"""Möbius transformations keep what they must, and centre what can be centred."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.parametrizers.sphere.areas import flipped_faces
from gipkg.parametrizers.sphere.moebius import centred, conformal_centre, translate
from tests.support.shapes import icosphere

inside = st.tuples(st.floats(0, 0.99), st.integers(0, 2**32 - 1))


def _direction(rng: np.random.Generator, *shape: int) -> np.ndarray:
    points = rng.normal(size=(*shape, 3))
    return points / np.linalg.norm(points, axis=-1, keepdims=True)


def _squared(points: np.ndarray, others: np.ndarray) -> np.ndarray:
    return ((points - others) ** 2).sum(axis=-1)


@given(inside)
def test_a_translation_is_a_conformal_map_of_the_sphere(drawn) -> None:
    radius, seed = drawn
    rng = np.random.default_rng(seed)
    c, x, y = radius * _direction(rng), _direction(rng, 50), _direction(rng, 50)
    moved_x, moved_y = translate(x, c), translate(y, c)
    assert np.allclose(np.linalg.norm(moved_x, axis=1), 1, atol=1e-12)
    # A map of the sphere is Möbius if chords change by a product of factors of their two ends.
    factors = (1 - radius**2) ** 2 / (_squared(x, c) * _squared(y, c))
    assert np.allclose(_squared(moved_x, moved_y), factors * _squared(x, y), rtol=1e-9, atol=1e-12)


@given(inside)
def test_a_translation_moves_its_point_to_the_origin_and_back(drawn) -> None:
    radius, seed = drawn
    rng = np.random.default_rng(seed)
    c = radius * _direction(rng)
    ball = _direction(rng, 20) * rng.random((20, 1))
    assert np.allclose(translate(c, c), 0, atol=1e-12)
    assert np.allclose(translate(translate(ball, c), -c), ball, atol=1e-9)


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1), st.floats(0.1, 50))
def test_the_mass_centre_comes_to_the_origin(seed: int, concentration: float) -> None:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)) + concentration * _direction(rng)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    masses = rng.uniform(0.1, 1, len(points))
    moved = translate(points, conformal_centre(points, masses))
    assert np.linalg.norm(masses @ moved) / masses.sum() < 1e-10


def test_centring_undoes_a_translation() -> None:
    mesh = icosphere(3)
    vertices = np.asarray(mesh.vertices)
    masses = np.bincount(mesh.faces.ravel(), np.repeat(mesh.area_faces, 3))
    moved = translate(vertices, np.array([0.3, -0.5, 0.4]))
    back = centred(moved, mesh.faces, masses)
    # Equal up to a rotation: all scalar products agree.
    assert np.abs(back @ back.T - vertices @ vertices.T).max() < 1e-9


def test_centring_stops_before_a_face_flips() -> None:
    mesh = icosphere(1)
    vertices = np.array(mesh.vertices)
    # One corner of a face comes so close to the opposite edge that the edge sweeps over it.
    apex, p, q = mesh.faces[0]
    towards = vertices[apex] - vertices[[p, q]].mean(axis=0)
    vertices[apex] = vertices[[p, q]].mean(axis=0) + 0.05 * towards
    vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
    assert not flipped_faces(vertices, mesh.faces).any()
    masses = np.exp(-3 * vertices @ towards / np.linalg.norm(towards))
    free = translate(vertices, conformal_centre(vertices, masses))
    held = centred(vertices, mesh.faces, masses)
    assert flipped_faces(free, mesh.faces).any()
    assert not flipped_faces(held, mesh.faces).any()
    assert np.linalg.norm(masses @ held) < np.linalg.norm(masses @ vertices)
