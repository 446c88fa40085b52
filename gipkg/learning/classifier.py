"""Any network on any views of shapes: trained on the ones, asked about the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from gipkg.learning.config import TrainingConfig
from gipkg.learning.device import choose_device, reproducible
from gipkg.learning.network import ViewClassifier
from gipkg.learning.prediction import Prediction
from gipkg.learning.training import train


@dataclass(frozen=True)
class Classifier:
    """A trained network and the k classes it tells apart."""

    network: ViewClassifier
    classes: tuple[str, ...]

    def predict(self, views_of: Callable[[str], Tensor], ids: Sequence[str]) -> Prediction:
        """Average softmax scores and signatures over the views of each shape.

        What is said of a shape depends on no other one.

        Parameters
        ----------
        views_of : callable
            Shape id to its (V, H, W, C) views.
        ids : sequence of str
        """
        weights = self.network.classifier.weight
        # Filled in place: small results kept one by one would fragment the memory of the views.
        scores, signatures = (np.zeros((len(ids), width), np.float32) for width in weights.shape)
        self.network.eval()
        with reproducible(weights.device, threads=1), torch.inference_mode():
            for i, shape_id in enumerate(ids):
                views = views_of(shape_id).permute(0, 3, 1, 2).to(weights.device)
                of_views, signatures_of_views = self.network(views)
                scores[i] = of_views.softmax(1).mean(0).cpu()
                signatures[i] = signatures_of_views.mean(0).cpu()
        return Prediction(tuple(ids), self.classes, scores, signatures)


def train_classifier(
    make_network: Callable[[int], ViewClassifier],
    views: Tensor,
    labels: Sequence[str],
    *,
    training: TrainingConfig,
    seed: int,
    device: str,
    checkpoint: Path | None,
) -> Classifier:
    """Train a network on views of shapes.

    Parameters
    ----------
    make_network : callable
        Number of classes k to a network.
    views : (n, V, H, W, C) tensor
        V views of each of n shapes.
    labels : sequence of n classes
    training : TrainingConfig
    seed : int
        Of the weights, the order of the views and dropout.
    device : str
        ``auto``, ``cpu``, ``cuda``, ``cuda:1``, …
    checkpoint : Path or None
        Where the state of the training is kept. A killed training goes on from there and ends
        equal to an undisturbed one; a finished one is not repeated.

    Raises
    ------
    LearningError
        The device is absent, there are fewer views of a shape than the network pools, or the
        training diverged.
    DamagedFileError
        The checkpoint cannot be read.
    """
    chosen = choose_device(device)
    classes = tuple(sorted(set(labels)))
    targets = torch.tensor([classes.index(label) for label in labels])
    with reproducible(chosen, training.threads):
        torch.manual_seed(seed)
        network = make_network(len(classes)).to(chosen)
        train(network, views, targets, training, seed, checkpoint)
    return Classifier(network, classes)
