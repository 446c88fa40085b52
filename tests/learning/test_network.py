from __future__ import annotations

import pytest
import torch
from torch import nn

from gipkg.errors import LearningError
from gipkg.learning.config import NetworkConfig
from gipkg.learning.network import ImageNetwork, feature_map_size


def test_the_network_is_that_of_the_paper() -> None:
    network = ImageNetwork(NetworkConfig(), channels=5, size=64, classes=30)
    convolutions = [layer for layer in network.modules() if isinstance(layer, nn.Conv2d)]
    linear = [layer for layer in network.modules() if isinstance(layer, nn.Linear)]
    assert [layer.out_channels for layer in convolutions] == [24, 48, 96]
    assert all(layer.padding == (0, 0) for layer in convolutions)
    assert [layer.out_features for layer in linear] == [48, 30]


@pytest.mark.parametrize("normalise", [True, False])
def test_batch_normalisation_is_optional(normalise: bool) -> None:
    network = ImageNetwork(NetworkConfig(batch_normalisation=normalise), 1, 64, 2)
    layers = [type(layer).__name__ for layer in network.modules()]
    assert ("BatchNorm2d" in layers) == ("BatchNorm1d" in layers) == normalise


DEEP = NetworkConfig(blocks=((8, 8), (16, 16), (32, 32)), pooling="average", features=96)


@pytest.mark.parametrize("config", [NetworkConfig(), DEEP])
@pytest.mark.parametrize("size", [63, 64, 75])
def test_the_size_of_the_feature_map_is_what_the_layers_leave(
    config: NetworkConfig, size: int
) -> None:
    network = ImageNetwork(config, channels=3, size=size, classes=4)
    images, width = torch.rand(2, 3, size, size), config.blocks[-1][-1]
    side = feature_map_size(config, size)
    before_pooling = network.convolutions[:-2](images) if config is DEEP else None
    if before_pooling is not None:
        assert before_pooling.shape == (2, width, side, side)
        expected = before_pooling.mean((2, 3))
        torch.testing.assert_close(network.convolutions(images), expected)
    else:
        assert network.convolutions(images).shape == (2, width * side**2)
    scores, signatures = network(images)
    assert (scores.shape, signatures.shape) == ((2, 4), (2, config.features))
    assert (signatures >= 0).all()  # after the rectifier


def test_views_pooled_together_are_of_one_shape_and_in_no_order() -> None:
    network = ImageNetwork(DEEP.model_copy(update={"together": 3}), 2, 64, classes=4)
    views = torch.rand(6, 2, 64, 64)
    assert network(views)[0].shape == (2, 4)  # learning: two shapes of three views each
    network.eval()
    scores, signatures = network(views)  # one shape of six views
    assert (scores.shape, signatures.shape) == ((1, 4), (1, 96))
    order = torch.tensor([4, 0, 5, 3, 1, 2])
    assert torch.equal(network(views[order])[1], signatures)
    pooled = network.convolutions(views).amax(0, keepdim=True)
    assert torch.equal(network.signature(pooled), signatures)


def test_images_that_are_too_small_are_refused() -> None:
    assert feature_map_size(NetworkConfig(), 43) == 1
    with pytest.raises(LearningError, match="42 pixels"):
        ImageNetwork(NetworkConfig(), channels=1, size=42, classes=2)
    with pytest.raises(LearningError, match="62 pixels"):
        ImageNetwork(DEEP, channels=1, size=62, classes=2)
