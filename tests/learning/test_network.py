from __future__ import annotations

import pytest
import torch
from torch import nn

from gipkg.learning.config import NetworkConfig
from gipkg.learning.feature_maps import feature_map_size
from gipkg.learning.network import ImageNetwork


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


PRINTED = NetworkConfig(pooling="local")
DEEP = NetworkConfig(blocks=((8, 8), (16, 16), (32, 32)), pooling="average", features=96)


@pytest.mark.parametrize("size", [63, 64, 75])
def test_the_size_of_the_feature_map_is_what_the_layers_leave(size: int) -> None:
    images = torch.rand(2, 3, size, size)
    side = feature_map_size(PRINTED, size)
    found = ImageNetwork(PRINTED, 3, size, classes=4).convolutions(images)
    assert found.shape == (2, 96 * side**2)
    side = feature_map_size(DEEP, size)
    assert ImageNetwork(DEEP, 3, size, 4).convolutions[:-2](images).shape == (2, 32, side, side)


@pytest.mark.parametrize("pooling", ["local", "average", "average+maximum"])
def test_scores_and_signatures_follow_what_is_pooled(pooling: str) -> None:
    network = ImageNetwork(DEEP.model_copy(update={"pooling": pooling}), 3, 80, classes=4)
    scores, signatures = network(torch.rand(2, 3, 80, 80))
    assert (scores.shape, signatures.shape) == ((2, 4), (2, 96))
    assert (signatures >= 0).all()  # after the rectifier
    if pooling == "local":
        return
    last = torch.rand(2, 32, 5, 5)
    found = network.convolutions[-2:](last)
    torch.testing.assert_close(found[:, :32], last.mean((2, 3)))
    assert torch.equal(found[:, 32:], last.amax((2, 3))[:, : found.shape[1] - 32])
    turned = network.convolutions[-2:](last.rot90(1, (2, 3)))
    torch.testing.assert_close(turned, found)


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
