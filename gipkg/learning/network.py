"""The networks on geometry images: that of the paper's Section 5, deeper ones, several views."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from gipkg.learning.config import NetworkConfig
from gipkg.learning.feature_maps import (
    FIRST_KERNEL,
    FIRST_STRIDE,
    KERNEL,
    POOL,
    feature_map_size,
    is_pooled_locally,
)


class ViewClassifier(nn.Module):
    """Views (B, C, H, W) to class scores before the softmax and signatures (B, features).

    Attributes
    ----------
    classifier : nn.Linear
        The last layer, from features to k scores.
    together : int
        1: every view is judged by itself. More: in training, as many consecutive views are of
        one shape and give one row, (B / together, k); in evaluation, all views given are.
    """

    classifier: nn.Linear
    together: int = 1


class ImageNetwork(ViewClassifier):
    """Unpadded convolutions with pooling, a fully connected layer, class scores.

    Parameters
    ----------
    config : NetworkConfig
    channels, size : int
        A view is (channels, size, size).
    classes : int
        Number of classes k.

    Raises
    ------
    LearningError
        At construction if nothing is left of so small a view.
    """

    def __init__(self, config: NetworkConfig, channels: int, size: int, classes: int) -> None:
        super().__init__()
        self.together = config.together
        normalised, side = config.batch_normalisation, feature_map_size(config, size)
        found = {"local": side**2, "average": 1, "average+maximum": 2}[config.pooling]
        self.convolutions = nn.Sequential(*_convolutions(config, channels), nn.Flatten())
        self.signature = nn.Sequential(
            nn.Dropout(config.dropout),
            nn.Linear(found * config.blocks[-1][-1], config.features, bias=not normalised),
            *([nn.BatchNorm1d(config.features)] if normalised else []),
            nn.ReLU(),
        )
        self.classifier = nn.Linear(config.features, classes)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # not annotated

    def forward(self, images: Tensor) -> tuple[Tensor, Tensor]:
        """Return the class scores before the softmax and the signatures, a row a view or shape.

        Images may be in half precision. What the convolutions find in views of a shape is pooled
        by its maximum, as Su, Maji, Kalogerakis & Learned-Miller do ("Multi-view Convolutional
        Neural Networks", ICCV 2015).
        """
        # Where convolutions compute in half precision, images are never in any other.
        device = images.device.type
        half = torch.is_autocast_enabled(device)
        precision = torch.get_autocast_dtype(device) if half else torch.float32
        found = self.convolutions(images.to(precision))
        if self.together > 1:
            views = self.together if self.training else len(images)
            found = found.unflatten(0, (-1, views)).amax(1)
        signatures = self.signature(found)
        return self.classifier(signatures), signatures


class GlobalPooling(nn.Module):
    """The average over all pixels, (B, C), and after it the maximum if wanted, (B, 2 C)."""

    def __init__(self, maximum: bool) -> None:
        super().__init__()
        self.maximum = maximum

    def forward(self, images: Tensor) -> Tensor:
        """Pool images, or what convolutions made of them."""
        average = images.mean((2, 3))
        return torch.cat([average, images.amax((2, 3))], 1) if self.maximum else average


def _convolutions(config: NetworkConfig, channels: int) -> list[nn.Module]:
    layers: list[nn.Module] = []
    inputs, kernel, stride = channels, FIRST_KERNEL, FIRST_STRIDE
    for number, block in enumerate(config.blocks):
        for width in block:
            layers += [
                nn.Conv2d(inputs, width, kernel, stride, bias=not config.batch_normalisation),
                *([nn.BatchNorm2d(width)] if config.batch_normalisation else []),
                nn.ReLU(),
            ]
            inputs, kernel, stride = width, KERNEL, 1
        if is_pooled_locally(config, number):
            # The two commute, and so the rectifier has a quarter of the pixels.
            layers.insert(-1, nn.MaxPool2d(POOL))
        else:
            layers.append(GlobalPooling(maximum=config.pooling == "average+maximum"))
    return layers
