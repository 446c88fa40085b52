import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import SphericalVoronoi

from gipkg.parametrizers.transport.power_diagram import power_diagram
from tests.support.shapes import fibonacci


def _sites(seed: int, count: int = 60) -> np.ndarray:
    sites = np.random.default_rng(seed).normal(size=(count, 3))
    return sites / np.linalg.norm(sites, axis=1, keepdims=True)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 2**31))
def test_equal_weights_give_the_voronoi_diagram(seed: int) -> None:
    sites = _sites(seed)
    diagram = power_diagram(3 * sites)
    expected = SphericalVoronoi(sites).calculate_areas()
    np.testing.assert_allclose(diagram.areas, expected, rtol=0, atol=1e-10)
    assert diagram.areas.sum() == pytest.approx(4 * np.pi, abs=1e-10)


def test_areas_and_centroids_agree_with_the_definition_of_the_cells() -> None:
    sites = _sites(0, 20)
    weights = np.random.default_rng(1).uniform(0, 0.1, 20)
    diagram = power_diagram(np.exp(weights)[:, None] * sites)
    count = 200_000
    x = fibonacci(count)
    products = x @ sites.T
    scores = np.where(products > 0, np.log(np.maximum(products, 1e-300)) + weights, -np.inf)
    cell = scores.argmax(axis=1)
    areas = np.bincount(cell, minlength=20) * 4 * np.pi / count
    np.testing.assert_allclose(diagram.areas, areas, atol=2e-3)
    for site in range(20):
        mean = x[cell == site].mean(axis=0)
        np.testing.assert_allclose(diagram.centroids[site], mean / np.linalg.norm(mean), atol=1e-2)


def test_slopes_are_the_derivatives_of_areas() -> None:
    sites, weights = _sites(2), np.random.default_rng(3).uniform(0, 0.02, 60)

    def areas_at(w: np.ndarray) -> np.ndarray:
        return power_diagram(np.exp(w)[:, None] * sites).areas

    diagram = power_diagram(np.exp(weights)[:, None] * sites)
    assert (diagram.areas > 0).all()
    jacobian = np.zeros((60, 60))
    first, second = diagram.sides.T
    jacobian[first, second] = jacobian[second, first] = -diagram.slopes
    np.fill_diagonal(jacobian, -jacobian.sum(axis=1))
    steps = 1e-6 * np.eye(60)
    numeric = np.array([(areas_at(weights + s) - areas_at(weights - s)) / 2e-6 for s in steps])
    np.testing.assert_allclose(jacobian, numeric, atol=1e-6)


def test_a_site_far_below_its_neighbours_has_no_cell() -> None:
    sites = _sites(4)
    sites[0] *= 0.2
    diagram = power_diagram(sites)
    assert diagram.areas[0] == 0
    assert (diagram.centroids[0] == 0).all()
    assert diagram.areas.sum() == pytest.approx(4 * np.pi, abs=1e-10)
