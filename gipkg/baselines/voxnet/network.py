"""The network of Maturana & Scherer (2015), Section III-C, as its authors released it."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from gipkg.learning.network import ViewClassifier

FILTERS = 32
FEATURES = 128
SLOPE = 0.1
DROPOUT = (0.2, 0.3, 0.4)
JITTER = 2
"""Voxels by which a grid is shifted at most, along each axis, while it is learned from."""


class VoxelNetwork(ViewClassifier):
    """Two convolutions, one maximum pooling, a fully connected layer of 128, class scores.

    Parameters
    ----------
    size : int
        The input is (B, size, size, size).
    classes : int
        Number of classes k.
    """

    def __init__(self, size: int, classes: int) -> None:
        super().__init__()
        side = ((size - 5) // 2 + 1 - 2) // 2
        self.signature = nn.Sequential(
            nn.Conv3d(1, FILTERS, 5, stride=2),
            nn.LeakyReLU(SLOPE),
            Dropout(DROPOUT[0]),
            nn.Conv3d(FILTERS, FILTERS, 3),
            nn.MaxPool3d(2),  # It and the rectifier commute: so that one has an eighth to do.
            nn.LeakyReLU(SLOPE),
            Dropout(DROPOUT[1]),
            nn.Flatten(),
            nn.Linear(FILTERS * side**3, FEATURES),
            nn.ReLU(),
        )
        self.dropout = Dropout(DROPOUT[2])
        self.classifier = nn.Linear(FEATURES, classes)
        for layer in self.modules():
            if isinstance(layer, nn.Conv3d):
                nn.init.kaiming_normal_(layer.weight, a=SLOPE)
            elif isinstance(layer, nn.Linear):
                nn.init.normal_(layer.weight, std=0.01)
        # In this order of memory, pooling takes a tenth of the time.
        self.to(memory_format=torch.channels_last_3d)  # type: ignore[call-overload]  # not annotated

    def forward(self, grids: Tensor) -> tuple[Tensor, Tensor]:
        """Return the class scores before the softmax (B, k) and the signatures (B, 128).

        A grid holds truth values, which become -1 and 1.
        """
        if self.training:
            grids = shifted(grids, JITTER)
        signatures = self.signature(2 * grids.unsqueeze(1).float() - 1)
        return self.classifier(self.dropout(signatures)), signatures


class Dropout(nn.Module):
    """Dropout from 16 random bits a unit: PyTorch's own took a fifth of a step on a processor.

    Parameters
    ----------
    share : float
        Of the units that are dropped, rounded to a multiple of 1 / 65536.
    """

    def __init__(self, share: float) -> None:
        super().__init__()
        self.dropped = round(share * 2**16)

    def forward(self, units: Tensor) -> Tensor:
        """Set units to 0 and scale the others so that the mean stays; in training only."""
        if not self.training:
            return units
        count, whole = units.numel(), torch.iinfo(torch.int64)
        words = torch.empty(-(-count // 4), dtype=torch.int64, device=units.device)
        bits = words.random_(whole.min, None).view(torch.int16)[:count].view(units.shape)
        kept = bits >= self.dropped - 2**15
        return units * kept.to(units.dtype).mul_(2**16 / (2**16 - self.dropped))


def shifted(grids: Tensor, most: int) -> Tensor:
    """Shift every grid (B, n, n, n) at random, by at most so many voxels along each axis.

    What leaves on one side enters on the other; it is empty where there is a margin.
    """
    shifts = torch.randint(-most, most + 1, (len(grids), 3)).tolist()
    return torch.stack(
        [grid.roll(shift, (0, 1, 2)) for grid, shift in zip(grids, shifts, strict=True)]
    )
