from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gipkg.parametrizers.sphere.areas import (
    area_gradients,
    flipped_faces,
    signed_spherical_areas,
    triple_products,
)

OCTANT = np.eye(3)
FORWARD, BACKWARD = np.array([[0, 1, 2]]), np.array([[0, 2, 1]])


def test_an_octant_is_an_eighth_of_the_sphere() -> None:
    assert signed_spherical_areas(OCTANT, FORWARD)[0] == pytest.approx(np.pi / 2, abs=1e-15)
    assert signed_spherical_areas(OCTANT, BACKWARD)[0] == pytest.approx(-np.pi / 2, abs=1e-15)
    assert flipped_faces(OCTANT, np.vstack((FORWARD, BACKWARD))).tolist() == [False, True]


@given(st.integers(0, 2**32 - 1))
def test_areas_agree_with_the_angle_excess(seed: int) -> None:
    p, q, r = corners = np.random.default_rng(seed).normal(size=(3, 3))
    corners /= np.linalg.norm(corners, axis=1, keepdims=True)
    excess = -np.pi
    for a, b, c in ((p, q, r), (q, r, p), (r, p, q)):
        u, v = np.cross(a, b), np.cross(a, c)
        excess += np.arccos(np.clip(u @ v / np.linalg.norm(u) / np.linalg.norm(v), -1, 1))
    sign = np.sign(np.linalg.det(corners))
    assert signed_spherical_areas(corners, FORWARD)[0] == pytest.approx(sign * excess, abs=1e-6)


@given(st.integers(0, 2**32 - 1), st.integers(-60, -1))
def test_the_sign_of_nearly_flat_faces_is_exact(seed: int, exponent: int) -> None:
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 3))
    p, q = p / np.linalg.norm(p), q / np.linalg.norm(q)
    r = p + q + rng.normal(size=3) * 2.0**exponent
    corners = np.array([p, q, r / np.linalg.norm(r)])
    rows = [[Fraction(float(x)) for x in corner] for corner in corners]
    exact = sum(
        rows[0][i] * (rows[1][j] * rows[2][k] - rows[1][k] * rows[2][j])
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    )
    assert flipped_faces(corners, FORWARD)[0] == (exact <= 0)


def test_degenerate_and_non_finite_faces_count_as_flipped() -> None:
    great_circle = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0]])
    assert flipped_faces(great_circle, FORWARD).all()
    assert flipped_faces(np.full((3, 3), np.nan), FORWARD).all()


def test_small_triangles_keep_their_relative_accuracy() -> None:
    size = 1e-7
    p = np.array([1.0, 2, 3]) / np.sqrt(14)
    u = np.cross(p, [0, 0, 1])
    u /= np.linalg.norm(u)
    corners = np.array([p, p + size * u, p + size * np.cross(p, u)])
    assert triple_products(corners, FORWARD)[0] == pytest.approx(size**2, rel=1e-8)


@given(seed=st.integers(0, 2**32 - 1))
def test_area_gradients_agree_with_finite_differences(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sphere = rng.standard_normal((3, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    face = np.array([[0, 1, 2]])
    determinant = abs(np.linalg.det(sphere))
    assume(determinant > 0.05)
    gradients = area_gradients(sphere, face)[0]
    for corner in range(3):
        tangent = np.cross(sphere[corner], rng.standard_normal(3))
        moved = []
        for step in (1e-6, -1e-6):
            points = sphere.copy()
            points[corner] += step * tangent
            points[corner] /= np.linalg.norm(points[corner])
            moved.append(signed_spherical_areas(points, face)[0])
        assert gradients[corner] @ tangent == pytest.approx(
            (moved[0] - moved[1]) / 2e-6, abs=1e-6 * (1 + 1 / determinant)
        )
