from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from gipkg.evaluation.surface_distance import SurfaceDistance, surface_distance
from tests.support.shapes import ellipsoid, icosphere


def box(*extents: float) -> trimesh.Trimesh:
    return trimesh.creation.box(extents)


def test_a_surface_is_at_no_distance_from_itself_however_it_is_triangulated() -> None:
    coarse = box(1, 2, 3)
    fine = coarse.subdivide().subdivide()
    measured = surface_distance(coarse, fine, samples=2000)
    assert measured.hausdorff == pytest.approx(0, abs=1e-12)
    assert measured.mean == pytest.approx(0, abs=1e-12)


def test_nested_cubes_are_farthest_at_their_corners() -> None:
    # From the outer cube's corner (2, 2, 2) to the inner one's (1, 1, 1); diagonal 2√3.
    measured = surface_distance(box(2, 2, 2), box(4, 4, 4), samples=20_000)
    assert measured.hausdorff == pytest.approx(0.5)
    # From inside every point is at distance 1; from outside, on a face, at least 1.
    outward = 1 / (2 * np.sqrt(3))
    assert outward < measured.mean < measured.hausdorff


def test_the_mean_distance_between_concentric_spheres_is_the_difference_of_radii() -> None:
    measured = surface_distance(icosphere(4), ellipsoid(1.5, 1.5, 1.5, subdivisions=4))
    assert measured.mean * 2 * np.sqrt(3) == pytest.approx(0.5, rel=0.005)


def test_what_one_surface_lacks_counts_whichever_comes_first() -> None:
    ball, egg = icosphere(3), ellipsoid(1, 1, 2)
    missing = surface_distance(egg, ball, samples=1000)
    added = surface_distance(ball, egg, samples=1000)
    # The pole of the egg is at distance 1; the boxes differ.
    assert missing.hausdorff * np.sqrt(24) == pytest.approx(1, rel=0.02)
    assert added.hausdorff * np.sqrt(12) == pytest.approx(1, rel=0.02)


@settings(max_examples=10)
@given(seed=st.integers(0, 2**32 - 1), scale=st.sampled_from([1e-6, 1.0, 1e6]))
def test_moving_and_scaling_both_changes_nothing(seed: int, scale: float) -> None:
    mesh, other = icosphere(2), ellipsoid(1.0, 1.2, 0.9, subdivisions=2)
    rng = np.random.default_rng(seed)
    placed = np.eye(4)
    placed[:3, :3] = scale * Rotation.random(random_state=seed).as_matrix()
    placed[:3, 3] = scale * rng.normal(size=3)
    before = _mean_relative_to_side(mesh, other)
    after = _mean_relative_to_side(
        mesh.copy().apply_transform(placed), other.copy().apply_transform(placed)
    )
    assert after == pytest.approx(before, rel=1e-6)


def _mean_relative_to_side(mesh: trimesh.Trimesh, other: trimesh.Trimesh) -> float:
    """Undo the one thing that a rotation changes, which is the bounding box."""
    measured = surface_distance(mesh, other, samples=500, seed=1)
    return measured.mean * np.linalg.norm(np.ptp(mesh.vertices, axis=0)) / np.sqrt(mesh.area)


def test_equal_seeds_give_equal_bits() -> None:
    mesh, other = icosphere(2), ellipsoid(1.0, 1.2, 0.9, subdivisions=2)
    once = surface_distance(mesh, other, samples=300, seed=5)
    assert isinstance(once, SurfaceDistance)
    assert surface_distance(mesh, other, samples=300, seed=5) == once
    assert surface_distance(mesh, other, samples=300, seed=6).mean != once.mean
