from __future__ import annotations

import numpy as np
import pytest

from gipkg.evaluation.distortion import Distortion
from gipkg.evaluation.histogram import BINS, area_histogram, bin_edges


def measured(sphere: list[float], mesh: list[float]) -> Distortion:
    scale = 4 * np.pi / sum(mesh)
    return Distortion(
        spherical_areas=np.array(sphere) * scale,
        mesh_areas=np.array(mesh) * scale,
        **dict.fromkeys(("flips", "degree", "face_std", "vertex_std"), 0),
        weighted_face_std=0,
        variance=0,
    )


def test_equal_areas_are_a_delta_at_zero() -> None:
    counts = area_histogram(measured([1, 2, 3, 4], [1, 2, 3, 4]))
    edges = bin_edges()
    (peak,) = np.flatnonzero(counts)
    assert counts[peak] == 4
    assert edges[peak] == pytest.approx(-edges[peak + 1])
    assert edges[peak] < 0 < edges[peak + 1]


def test_the_unit_is_the_mean_triangle_and_nothing_is_lost() -> None:
    # Mean area 1; the excess is 0.5, -0.5, 7 and -3.
    counts = area_histogram(measured([1.5, 0.5, 8, -2], [1, 1, 1, 1]))
    edges = bin_edges()
    assert counts.shape == (BINS,)
    assert counts.sum() == 4
    assert counts[0] == 1
    assert counts[-1] == 1
    for value in (0.5, -0.5):
        assert counts[np.searchsorted(edges, value) - 1] == 1
