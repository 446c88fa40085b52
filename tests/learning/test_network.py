from __future__ import annotations

import pytest
import torch
from torch import nn

from gipkg.errors import LearningError
from gipkg.learning.config import NetworkConfig
from gipkg.learning.network import ShallowNetwork, feature_map_size


def test_the_network_is_that_of_the_paper() -> None:
    network = ShallowNetwork(NetworkConfig(), channels=5, size=64, classes=30)
    convolutions = [layer for layer in network.modules() if isinstance(layer, nn.Conv2d)]
    linear = [layer for layer in network.modules() if isinstance(layer, nn.Linear)]
    assert [layer.out_channels for layer in convolutions] == [24, 48, 96]
    assert all(layer.padding == (0, 0) for layer in convolutions)
    assert [layer.out_features for layer in linear] == [48, 30]


@pytest.mark.parametrize("normalise", [True, False])
def test_batch_normalisation_is_optional(normalise: bool) -> None:
    network = ShallowNetwork(NetworkConfig(batch_normalisation=normalise), 1, 64, 2)
    layers = [type(layer).__name__ for layer in network.modules()]
    assert ("BatchNorm2d" in layers) == ("BatchNorm1d" in layers) == normalise


@pytest.mark.parametrize("size", [43, 51, 64, 72, 128])
def test_the_size_of_the_feature_map_is_what_the_layers_leave(size: int) -> None:
    network = ShallowNetwork(NetworkConfig(), channels=3, size=size, classes=4)
    flatten = next(i for i, layer in enumerate(network.signature) if isinstance(layer, nn.Flatten))
    side = feature_map_size(size)
    assert network.signature[:flatten](torch.zeros(2, 3, size, size)).shape == (2, 96, side, side)
    scores, signatures = network(torch.zeros(2, 3, size, size))
    assert (scores.shape, signatures.shape) == ((2, 4), (2, 48))
    assert (signatures >= 0).all()  # after the rectifier


def test_images_that_are_too_small_are_refused() -> None:
    assert feature_map_size(43) == 1
    with pytest.raises(LearningError, match="42 pixels"):
        ShallowNetwork(NetworkConfig(), channels=1, size=42, classes=2)
