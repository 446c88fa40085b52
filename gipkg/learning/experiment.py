"""Train on one part of a split, predict the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.device import choose_device, reproducible
from gipkg.learning.network import ShallowNetwork, ViewClassifier
from gipkg.learning.prediction import Prediction
from gipkg.learning.training import train
from gipkg.learning.views import Layout, fit_scale, stack


def train_and_predict(
    images: Mapping[str, NDArray[np.float32]],
    labels: Mapping[str, str],
    train_ids: Sequence[str],
    test_ids: Sequence[str],
    *,
    network: NetworkConfig | None = None,
    training: TrainingConfig | None = None,
    seed: int = 0,
    device: str = "auto",
    checkpoint: Path | None = None,
) -> Prediction:
    """Train a network on some shapes and predict others.

    Nothing about the test shapes reaches the training; their labels are not even read.

    Parameters
    ----------
    images : mapping of shape id to (V, C, n, n) float32 array
        The V geometry images of each shape, unpadded. Read shape by shape; the training part
        is then held in memory.
    labels : mapping of shape id to class
        For the training part.
    train_ids, test_ids : sequence of str
        The two parts; their order is part of the result.
    network, training : optional
        By default the network and training of today.
    seed : int
        Of the weights, the order of the views, dropout and the shuffled layout.
    device : str
        ``auto``, ``cpu``, ``cuda``, ``cuda:1``, …
    checkpoint : Path, optional
        Where the state of the training is kept. A killed training goes on from there and ends
        equal to an undisturbed one; a finished one is not repeated.

    Returns
    -------
    Prediction
        Scores are the softmax averaged over the views of a shape, embeddings the activations
        of the fully connected layer averaged likewise.

    Raises
    ------
    LearningError
        The images are too small for the network, the device is absent, or the training
        diverged.
    DamagedFileError
        The checkpoint cannot be read.
    """
    network, training = network or NetworkConfig(), training or TrainingConfig()
    size = images[train_ids[0]].shape[-1]
    layout = Layout(network.margin, permutation(size, seed) if training.shuffle_pixels else None)
    with reproducible(choose_device(device), training.threads):
        views = stack(images, train_ids, layout)
        scale = fit_scale(views, jointly=training.scaling == "joint")
        for shape in views:
            shape.copy_(scale(shape))
        return learn_views(
            lambda classes: ShallowNetwork(network, views.shape[-1], views.shape[-2], classes),
            views,
            [labels[i] for i in train_ids],
            lambda shape_id: scale(torch.from_numpy(layout(images[shape_id]))),
            test_ids,
            training=training,
            seed=seed,
            device=device,
            checkpoint=checkpoint,
        )


def learn_views(
    make_network: Callable[[int], ViewClassifier],
    views: Tensor,
    labels: Sequence[str],
    views_of: Callable[[str], Tensor],
    test_ids: Sequence[str],
    *,
    training: TrainingConfig,
    seed: int,
    device: str,
    checkpoint: Path | None,
) -> Prediction:
    """Train any network on views of some shapes and predict others from theirs.

    Parameters
    ----------
    make_network : callable
        Number of classes k to a network.
    views : (n, V, H, W, C) tensor
        V views of each of n training shapes.
    labels : sequence of n classes
    views_of : callable
        Test shape id to its (V, H, W, C) views.
    test_ids : sequence of str
    training, seed, device, checkpoint
        As for :func:`train_and_predict`, which says what is returned and raised.
    """
    chosen = choose_device(device)
    classes = tuple(sorted(set(labels)))
    targets = torch.tensor([classes.index(label) for label in labels])
    with reproducible(chosen, training.threads):
        torch.manual_seed(seed)
        network = make_network(len(classes)).to(chosen)
        train(network, views, targets, training, seed, checkpoint)
        scores, embeddings = predict(network, views_of, test_ids)
    return Prediction(tuple(test_ids), classes, scores, embeddings)


def permutation(size: int, seed: int) -> NDArray[np.int64]:
    """Return the one random order of the pixels of all images of a shuffled layout."""
    return np.random.default_rng(seed).permutation(size**2)


@torch.inference_mode()
def predict(
    network: ViewClassifier, views_of: Callable[[str], Tensor], ids: Sequence[str]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Average softmax scores (n, k) and signatures (n, features) over the views of each shape."""
    network.eval()
    weights = network.classifier.weight
    # Filled in place: small results kept one by one would fragment the memory of the large ones.
    pooled_scores, pooled_signatures = (
        np.zeros((len(ids), width), np.float32) for width in weights.shape
    )
    for i, shape_id in enumerate(ids):
        scores, signatures = network(views_of(shape_id).permute(0, 3, 1, 2).to(weights.device))
        pooled_scores[i] = scores.softmax(1).mean(0).cpu()
        pooled_signatures[i] = signatures.mean(0).cpu()
    return pooled_scores, pooled_signatures
