"""Convolutions around a cylinder, and the greatest value of every row."""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor, nn
from torch.nn.functional import pad

from gipkg.learning.network import ViewClassifier

KERNELS = (5, 5, 3, 3)
STRIDE = 2 ** len(KERNELS)
"""Columns of the panorama that become one of the last feature maps."""
DROPOUT = 0.5


class PanoramaNetwork(ViewClassifier):
    """Four blocks of a convolution and a maximum pooling, row-wise maxima, one layer, scores.

    Parameters
    ----------
    rows, columns : int
        The input is (B, 1, rows, columns), whole numbers from 0 to 255.
    maps : sequence of int
        Feature maps of the four blocks.
    features : int
        Width of the fully connected layer.
    classes : int
        Number of classes k.
    """

    def __init__(
        self, rows: int, columns: int, maps: Sequence[int], features: int, classes: int
    ) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        channels = 1
        for width, kernel in zip(maps, KERNELS, strict=True):
            layers += [AroundCylinder(channels, width, kernel), nn.ReLU(), nn.MaxPool2d(2)]
            channels = width
        self.convolutions = nn.Sequential(*layers)
        self.signature = nn.Sequential(nn.Linear(channels * (rows // STRIDE), features), nn.ReLU())
        self.dropout = nn.Dropout(DROPOUT)
        self.classifier = nn.Linear(features, classes)
        for layer in self.modules():
            if isinstance(layer, nn.Conv2d):
                nn.init.kaiming_normal_(layer.weight)

    def forward(self, panoramas: Tensor) -> tuple[Tensor, Tensor]:
        """Return the class scores before the softmax (B, k) and the signatures (B, features).

        The panorama of a turned shape is the same, its columns shifted. A shift by multiples of
        16 changes nothing; the others come to be seen at random while the network learns.
        """
        if self.training:
            panoramas = turned(panoramas)
        maps = self.convolutions(panoramas.float() / 255)
        signatures = self.signature(maps.amax(3).flatten(1))
        return self.classifier(self.dropout(signatures)), signatures


class AroundCylinder(nn.Conv2d):
    """A convolution whose input goes on at its left where it ends at its right.

    Above and below it goes on with zeros; the size stays.
    """

    def __init__(self, channels: int, features: int, kernel: int) -> None:
        super().__init__(channels, features, kernel, padding=(kernel // 2, 0))

    def forward(self, maps: Tensor) -> Tensor:
        """Return (B, features, H, W) for (B, channels, H, W)."""
        margin = self.kernel_size[1] // 2
        return super().forward(pad(maps, (margin, margin, 0, 0), mode="circular"))


def turned(panoramas: Tensor) -> Tensor:
    """Shift the columns of every panorama at random; reverse them in every other one.

    So they are of turned shapes, every other one mirrored.
    """
    count, _, _, columns = panoramas.shape
    shifts = torch.randint(columns, (count, 1)).to(panoramas.device)
    order = torch.arange(columns, device=panoramas.device).expand(count, -1).clone()
    order[::2] = order[::2].flip(1)
    order = (order + shifts) % columns
    return panoramas.gather(3, order[:, None, None].expand_as(panoramas))


def every_shift(panorama: Tensor) -> Tensor:
    """Stack a panorama (1, H, W, 1) in the 16 shifts that the network tells apart: (16, H, W, 1).

    Shifting the panorama changes no more than their order.
    """
    return torch.cat([panorama.roll(shift, 2) for shift in range(STRIDE)])
