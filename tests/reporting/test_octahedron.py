"""The octahedron's edges are where the unfolding has its lines, on all three surfaces."""

from __future__ import annotations

import numpy as np
import pytest

from gipkg.images.octahedron import pixel_directions, square_to_sphere
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.octahedron import SOUTH, edges, sphere_to_octahedron


def test_points_land_on_the_octahedron() -> None:
    directions = np.random.default_rng(0).standard_normal((1000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    moved = sphere_to_octahedron(directions)
    assert np.abs(moved).sum(axis=1) == pytest.approx(1)
    assert np.array_equal(np.sign(moved), np.sign(directions))
    corners = np.concatenate([np.eye(3), -np.eye(3)])
    assert sphere_to_octahedron(corners) == pytest.approx(corners)


def test_areas_are_kept_on_the_way() -> None:
    sphere = reconstruct(np.moveaxis(pixel_directions(129), -1, 0))
    centres = sphere.triangles_center / np.linalg.norm(sphere.triangles_center, axis=1)[:, None]
    x, y, _ = np.abs(sphere_to_octahedron(centres)).T
    # The moments of barycentric coordinates over a triangle.
    for function, mean in ((x, 1 / 3), (x**2, 1 / 6), (x * y, 1 / 12), (x**2 * y, 1 / 30)):
        assert np.average(function, weights=sphere.area_faces) == pytest.approx(mean, abs=2e-4)


def test_there_are_twelve_edges_and_four_are_cut() -> None:
    every = edges()
    ends = {frozenset(map(tuple, (edge.start, edge.end))) for edge in every}
    assert len(ends) == 12
    assert all(np.linalg.norm(edge.start - edge.end) == pytest.approx(2**0.5) for edge in every)
    assert [edge.cut for edge in every] == [True] * 4 + [False] * 8
    assert all(np.array_equal(edge.start, SOUTH) == edge.cut for edge in every)


def test_an_edge_is_the_same_on_sphere_octahedron_and_square() -> None:
    for edge in edges():
        direction = edge.end - edge.start
        from_sphere = sphere_to_octahedron(edge.arc)
        share = (from_sphere - edge.start) @ direction / 2
        assert from_sphere == pytest.approx(edge.start + share[:, None] * direction)
        segments = edge.on_square
        assert len(segments) == (2 if edge.cut else 1)
        for first, last in segments:
            points = np.linspace(first, last, 9)
            assert np.abs(points).max() == pytest.approx(1) or not edge.cut
            back = sphere_to_octahedron(square_to_sphere(points))
            away = np.cross(back - edge.start, direction)
            assert away == pytest.approx(0, abs=1e-12)
            span = (back - edge.start) @ direction / 2
            assert sorted(span[[0, -1]]) == pytest.approx([0, 1])
