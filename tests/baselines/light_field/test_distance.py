from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from gipkg.baselines.light_field.cameras import SYSTEMS, VIEWS, alignments
from gipkg.baselines.light_field.distance import WEIGHTS, pairwise_distances, quantise
from gipkg.baselines.light_field.features import COUNT


def features(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).random((SYSTEMS, VIEWS, COUNT)).astype(np.float32)


def test_the_distance_is_the_least_over_attitudes_and_alignments() -> None:
    shapes = quantise(np.stack([features(0), features(1), features(2)]))
    found = pairwise_distances(shapes)
    for a, b in ((0, 1), (0, 2), (1, 2)):
        one, other = shapes[a].astype(int), shapes[b].astype(int)
        expected = min(
            np.abs(one[i] - other[j][permutation]).sum()
            for i in range(SYSTEMS)
            for j in range(SYSTEMS)
            for permutation in alignments()
        )
        assert found[a, b] == found[b, a] == expected
    assert_array_equal(found.diagonal(), 0)


def test_a_shape_seen_from_other_cameras_is_the_same() -> None:
    one = features(3)
    other = features(4)
    # Its second attitude shows what the first one of `one` does after a turn.
    other[1] = one[0][alignments()[17]]
    assert pairwise_distances(quantise(np.stack([one, other])))[0, 1] == 0


def test_features_count_by_their_weights() -> None:
    assert len(WEIGHTS) == COUNT
    assert quantise(np.ones(COUNT)).tolist() == [255] * 35 + [1020] * 10 + [510, 255]
    assert quantise(np.full(COUNT, 7.0)).max() == 1020
