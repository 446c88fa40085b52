"""The square's map of the sphere: inverse, area, cut and poles."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.images.octahedron import pixel_directions, sphere_to_square, square_to_sphere
from gipkg.images.sampling import SAMPLINGS


def triangle_quadrature(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Points (N, 2) inside the triangle u, v > 0, u + v < 1 and weights that sum to 1."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    u, v = np.meshgrid((x + 1) / 2, (x + 1) / 2)
    weights = np.outer(w, w) / 2 * (1 - u)
    return np.column_stack([u.ravel(), (v * (1 - u)).ravel()]), weights.ravel()


def jacobian(points: np.ndarray, sampling: str) -> np.ndarray:
    """Area on the sphere per area in the square, by differences of fourth order, over π."""
    inside = np.abs(points)
    rims = [inside.min(1), 1 - inside.max(1), np.abs(inside.sum(1) - 1)]
    step = np.minimum(np.min(rims, axis=0) / 8, 1e-3)[:, None]

    def slope(axis: list[int]) -> np.ndarray:
        near, far = (
            square_to_sphere(points + k * step * axis, sampling)
            - square_to_sphere(points - k * step * axis, sampling)
            for k in (1, 2)
        )
        return (8 * near - far) / (12 * step)

    return np.linalg.norm(np.cross(slope([1, 0]), slope([0, 1])), axis=1) / np.pi


@pytest.mark.parametrize("sampling", SAMPLINGS)
def test_both_ways_are_inverse(sampling: str) -> None:
    rng = np.random.default_rng(0)
    points = rng.uniform(-1, 1, (20_000, 2))
    directions = square_to_sphere(points, sampling)
    assert_allclose(np.linalg.norm(directions, axis=1), 1, atol=1e-15)
    assert_allclose(sphere_to_square(directions, sampling), points, atol=1e-15)
    near_poles = rng.standard_normal((20_000, 3)) * 10.0 ** rng.uniform(-12, 0, (20_000, 1))
    near_poles[:, 2] = rng.choice([-1, 1], 20_000)
    near_poles /= np.linalg.norm(near_poles, axis=1, keepdims=True)
    back = square_to_sphere(sphere_to_square(near_poles, sampling), sampling)
    assert_allclose(back, near_poles, atol=2e-15)


def test_area_is_exact_everywhere() -> None:
    points = np.random.default_rng(1).uniform(-1, 1, (5_000, 2))
    inside = np.abs(points)
    away = (inside.min(1) > 0.02) & (inside.max(1) < 0.98) & (np.abs(inside.sum(1) - 1) > 0.02)
    assert_allclose(jacobian(points[away], "equal-area"), 1, atol=2e-7)
    centres = np.array([[0.3, 0.3], [-0.6, 0.2], [0.8, -0.7], [-0.55, -0.85]])
    assert_allclose(jacobian(centres, "equal-area"), 1, atol=1e-11)


def test_every_cell_has_the_same_area_on_the_sphere() -> None:
    """By Archimedes: the area between a curve and a pole is that of its longitude times 1 ∓ z."""
    n, nodes = 8, 40
    x, w = np.polynomial.legendre.leggauss(nodes)
    ends = 2 * np.arange(n + 1) / n - 1
    areas = np.zeros((n // 2, n // 2))
    for i, j in np.ndindex(areas.shape):  # one quadrant, by symmetry
        left, right, low, high = (ends[n // 2 + k] for k in (j, j + 1, i, i + 1))
        pole = 1 if low + right < 1 else -1
        corners = [(left, low), (right, low), (right, high), (left, high), (left, low)]
        for start, end in pairwise(corners):
            start, end = np.array(start), np.array(end)
            middle = start + np.outer((x + 1) / 2, end - start)
            # Longitudes at the nodes, differentiated as the polynomial through them.
            direction = square_to_sphere(middle)
            longitude = np.arctan2(direction[:, 1], direction[:, 0])
            slope = np.polynomial.legendre.legder(
                np.polynomial.legendre.legfit(x, longitude, nodes - 1)
            )
            areas[i, j] += w @ ((pole - direction[:, 2]) * np.polynomial.legendre.legval(x, slope))
    assert_allclose(areas, 4 * np.pi / n**2, rtol=1e-10)


def test_the_authors_sampling_is_not_equal_area() -> None:
    points, weights = triangle_quadrature(60)
    per_square = jacobian(points, "authors")
    assert weights @ per_square == pytest.approx(1, abs=1e-8)
    density = 1 / per_square  # pixels per area on the sphere
    spread = np.sqrt(weights @ (per_square * (density - 1) ** 2))
    assert spread == pytest.approx(0.0778, abs=1e-4)
    assert density.min() == pytest.approx(0.8865, abs=1e-4)
    assert density.max() == pytest.approx(4 / np.pi, abs=1e-3)


@pytest.mark.parametrize("sampling", SAMPLINGS)
@pytest.mark.parametrize("size", [3, 8, 56, 57])
def test_border_pixels_that_the_cut_identifies_are_bit_equal(size: int, sampling: str) -> None:
    directions = pixel_directions(size, sampling)
    for side in (directions[0], directions[-1], directions[:, 0], directions[:, -1]):
        assert_array_equal(side, side[::-1])
        assert_array_equal(side[0], [0, 0, -1])
        assert (side[1:-1, 2] <= 0).all()
        assert (np.abs(side[:, :2]).min(axis=1) == 0).all()


@pytest.mark.parametrize("sampling", SAMPLINGS)
def test_the_octahedron_lies_on_the_square_as_described(sampling: str) -> None:
    directions = pixel_directions(5, sampling)
    assert_allclose(directions[2, 2], [0, 0, 1], atol=1e-15)
    assert_allclose(directions[2, 4], [1, 0, 0], atol=1e-15)
    assert_allclose(directions[0, 2], [0, 1, 0], atol=1e-15)  # row 0 is the top
    u = np.linspace(-1, 1, 41)
    diamond = square_to_sphere(np.column_stack([u, 1 - np.abs(u)]), sampling)
    assert_allclose(diamond[:, 2], 0, atol=1e-15)


def test_an_unknown_sampling_is_named() -> None:
    with pytest.raises(ValueError, match="'gnomonic', not one of equal-area, authors"):
        pixel_directions(8, "gnomonic")
