"""The shallow network of the paper's Section 5."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from gipkg.errors import LearningError
from gipkg.learning.config import NetworkConfig

KERNELS = (5, 3, 3)
STRIDES = (2, 1, 1)
POOL = 2


def feature_map_size(size: int) -> int:
    """Side of the last feature map for square inputs of side `size`: 2 for 64.

    Raises
    ------
    LearningError
        Nothing is left of so small an image.
    """
    side = size
    for kernel, stride in zip(KERNELS, STRIDES, strict=True):
        side = ((side - kernel) // stride + 1) // POOL
    if side < 1:
        raise LearningError(
            f"images of {size} pixels a side, padding included, are too small for the network: "
            "use larger images or a wider margin"
        )
    return side


class ViewClassifier(nn.Module):
    """Views (B, C, H, W) to class scores before the softmax (B, k) and signatures (B, features).

    Attributes
    ----------
    classifier : nn.Linear
        The last layer, from features to k scores.
    """

    classifier: nn.Linear


class ShallowNetwork(ViewClassifier):
    """Three unpadded convolutions with maximum pooling, a fully connected layer, class scores.

    Parameters
    ----------
    config : NetworkConfig
    channels, size : int
        The input is (B, channels, size, size).
    classes : int
        Number of classes k.
    """

    def __init__(self, config: NetworkConfig, channels: int, size: int, classes: int) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        inputs = channels
        for width, kernel, stride in zip(config.widths, KERNELS, STRIDES, strict=True):
            layers += [
                nn.Conv2d(inputs, width, kernel, stride, bias=not config.batch_normalisation),
                *([nn.BatchNorm2d(width)] if config.batch_normalisation else []),
                nn.ReLU(),
                nn.MaxPool2d(POOL),
            ]
            inputs = width
        flat = inputs * feature_map_size(size) ** 2
        self.signature = nn.Sequential(
            *layers,
            nn.Flatten(),
            nn.Dropout(config.dropout),
            nn.Linear(flat, config.features, bias=not config.batch_normalisation),
            *([nn.BatchNorm1d(config.features)] if config.batch_normalisation else []),
            nn.ReLU(),
        )
        self.classifier = nn.Linear(config.features, classes)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # not annotated

    def forward(self, images: Tensor) -> tuple[Tensor, Tensor]:
        """Return the class scores before the softmax (B, k) and the signatures (B, features)."""
        signatures = self.signature(images)
        return self.classifier(signatures), signatures
