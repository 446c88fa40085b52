"""The classifier that a belief network becomes: its way up, and a softmax on top."""

from __future__ import annotations

from typing import cast

from torch import Tensor, nn

from gipkg.baselines.shapenets.belief import BeliefNetwork, BoltzmannMachine
from gipkg.baselines.shapenets.bits import unpack
from gipkg.learning.network import ViewClassifier


class ShapeNetsNetwork(ViewClassifier):
    """The filters of a belief network as layers of sigmoid units, and class scores.

    Parameters
    ----------
    belief : BeliefNetwork
        Its filters become the network's own.
    size : int
        The input is (B, ⌈size / 8⌉, size, size), packed grids.
    classes : int
        Number of classes k.
    """

    def __init__(self, belief: BeliefNetwork, size: int, classes: int) -> None:
        super().__init__()
        self.size = size
        layers: list[nn.Module] = []
        for machine in belief.machines:
            layers += [cast("BoltzmannMachine", machine).convolution, nn.Sigmoid()]
        self.signature = nn.Sequential(*layers, nn.Flatten())
        features = cast("nn.Conv3d", layers[-2]).out_channels
        self.classifier = nn.Linear(features, classes)

    def forward(self, images: Tensor) -> tuple[Tensor, Tensor]:
        """Return the class scores before the softmax (B, k) and the signatures (B, features)."""
        signatures = self.signature(unpack(images, self.size))
        return self.classifier(signatures), signatures
