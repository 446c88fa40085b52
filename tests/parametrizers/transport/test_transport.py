import numpy as np
import pytest

from gipkg.parametrizers.transport.transport import transport
from tests.support.shapes import fibonacci


def _contracted(points: np.ndarray, radius: float, factor: float) -> np.ndarray:
    """Draw the cap of that angular radius about the north pole together by a factor."""
    x, y, z = points.T
    colatitude = np.arctan2(np.hypot(x, y), z)
    colatitude = np.where(colatitude < radius, colatitude * factor, colatitude)
    turn = np.arctan2(y, x)
    ring = np.sin(colatitude)
    return np.column_stack((ring * np.cos(turn), ring * np.sin(turn), np.cos(colatitude)))


def test_points_that_stand_for_equal_areas_hardly_move() -> None:
    points = fibonacci(500)
    moved = transport(points, np.full(500, 4 * np.pi / 500), max_iterations=20, tolerance=1e-9)
    assert np.linalg.norm(moved - points, axis=1).max() < 0.3 * np.sqrt(4 * np.pi / 500)


def test_an_axial_contraction_is_undone() -> None:
    # Optimal for any cost that grows with the distance: monotone along every meridian.
    points = fibonacci(2000)
    x, y, z = points.T
    stereographic = np.tan(np.arctan2(np.hypot(x, y), z) / 2) / 2  # a Möbius map
    colatitude, turn = 2 * np.arctan(stereographic), np.arctan2(y, x)
    ring = np.sin(colatitude)
    sites = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), np.cos(colatitude)))
    areas = np.full(2000, 4 * np.pi / 2000)
    moved = transport(sites, areas, max_iterations=50, tolerance=1e-9)
    spacing = np.sqrt(4 * np.pi / 2000)
    distance = np.linalg.norm(moved - points, axis=1)
    assert np.median(distance) < 0.15 * spacing
    assert distance.max() < spacing


@pytest.mark.parametrize("factor", [1e-3, 1e-6, 1e-8])
def test_a_limb_in_a_spot_is_spread_over_its_area(factor: float) -> None:
    points = fibonacci(800)
    told = []
    moved = transport(
        _contracted(points, 0.6, factor),
        np.full(800, 4 * np.pi / 800),
        max_iterations=100,
        tolerance=1e-6,
        callback=told.append,
    )
    assert told[0].number == 0
    assert told[0].objective > 0.05
    assert told[-1].objective <= 1e-6
    assert np.array_equal(told[-1].sphere, moved)
    nearest = np.linalg.norm(moved[:, None] - moved, axis=2) + 2 * np.eye(800)
    assert nearest.min() > 0.2 * np.sqrt(4 * np.pi / 800)


def test_sites_in_one_place_share_a_centroid() -> None:
    sites = np.vstack((fibonacci(200), fibonacci(200)[:1]))
    moved = transport(sites, np.full(201, 4 * np.pi / 201), max_iterations=30, tolerance=1e-9)
    assert (moved[0] == moved[200]).all()
    assert len(np.unique(moved, axis=0)) == 200
