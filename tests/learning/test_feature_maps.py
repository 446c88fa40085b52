from __future__ import annotations

import pytest

from gipkg.errors import LearningError
from gipkg.learning.config import NetworkConfig
from gipkg.learning.feature_maps import feature_map_size, padded_size
from gipkg.learning.network import ImageNetwork

PRINTED = NetworkConfig(pooling="local")
DEEP = NetworkConfig(blocks=((8, 8), (16, 16), (32, 32)), pooling="average", features=96)


def test_images_that_are_too_small_are_refused() -> None:
    assert feature_map_size(PRINTED, 43) == 1
    with pytest.raises(LearningError, match="42 pixels"):
        ImageNetwork(PRINTED, channels=1, size=42, classes=2)
    with pytest.raises(LearningError, match="62 pixels"):
        ImageNetwork(DEEP, channels=1, size=62, classes=2)


def test_an_image_is_continued_by_less_than_itself() -> None:
    assert padded_size(NetworkConfig(), 56) == 64
    assert padded_size(NetworkConfig(margin=27), 28) == 82
    with pytest.raises(LearningError, match=r"28 pixels a side .* margin of 28"):
        padded_size(NetworkConfig(margin=28), 28)
