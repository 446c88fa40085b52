"""The contractible hull: of genus 0 for any solid, and its membranes where they belong."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.surfaces.volumes.lattice import NEIGHBOURS, simple_links
from gipkg.surfaces.volumes.shrinking import contractible_hull
from gipkg.surfaces.volumes.topology import count_topology
from tests.surfaces.volumes.solids import ball, blobs, grid, ring


def assert_contractible(hull: np.ndarray) -> None:
    counts = count_topology(hull)
    assert (counts.components, counts.cavities, counts.tunnels) == (1, 0, 0)


@given(st.integers(0, 10**6), st.floats(0.0, 2.0), st.floats(0.01, 0.9))
@settings(max_examples=30)
def test_any_solid_gets_a_contractible_hull(seed, smoothness, share):
    solid = np.pad(blobs(seed, 10, smoothness, share), 1)
    hull = contractible_hull(solid)
    assert_contractible(hull)
    assert (hull | solid == hull).all()


@pytest.mark.parametrize("solid", [ball(12), ball(3, (4, 5, 6)), np.pad(np.ones((3, 4, 5)) > 0, 1)])
def test_a_contractible_solid_is_its_own_hull(solid):
    assert np.array_equal(contractible_hull(solid), solid)


def test_a_bent_solid_with_a_narrow_gap_is_its_own_hull():
    """The hole of an open ring closes for a while, until the water falls to its gap."""
    solid = ring(11, 4)
    solid[20:, 19:21] = False
    assert np.array_equal(contractible_hull(solid), solid)


def test_a_tunnel_ends_as_a_thin_membrane_across_its_middle():
    solid = ring(11, 4)
    added = contractible_hull(solid) & ~solid
    x, y, z = grid()
    assert (np.hypot(x, y)[added] < 8).all()
    # Along the lattice's diagonal a membrane tilts by a voxel or two.
    assert (np.abs(z[added]) < 3).all()
    assert added.sum(axis=2).max() == 1


def test_a_membrane_closes_the_narrowest_place():
    """A funnel through a block, narrowest at three quarters of its length."""
    x, y, z = grid()
    block = (np.abs(x) < 14) & (np.abs(y) < 14) & (np.abs(z) < 16)
    solid = block & (np.hypot(x, y) > 3 + 0.3 * np.abs(z - 8))
    added = contractible_hull(solid) & ~solid
    assert added.any()
    assert (np.abs(z[added] - 8) < 3).all()


def test_parts_are_joined_where_they_come_closest():
    solid = ball(7, (-9, 0, 0)) | ball(7, (9, 0, 0))
    hull = contractible_hull(solid)
    added = np.argwhere(hull & ~solid) - 19.5
    assert_contractible(hull)
    assert (np.abs(added) <= 3).all()
    assert len(added) <= 6


def test_nothing_simple_is_left_to_remove():
    solid = np.pad(blobs(5, 12), 1)
    hull = contractible_hull(solid)
    for voxel in np.argwhere(hull & ~solid):
        link = sum(int(hull[tuple(voxel + step)]) << k for k, step in enumerate(NEIGHBOURS))
        assert not simple_links()[link]
