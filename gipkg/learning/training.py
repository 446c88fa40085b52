"""The training loop.

It is our own, since all that a resumed training needs to be equal to an undisturbed one bit by
bit is that every random choice is a function of the seed and the step, and that is simpler to
see in a page than to arrange in a framework.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.optim import SGD, AdamW, Optimizer

from gipkg.errors import LearningError
from gipkg.learning.checkpoint import Checkpoint, fingerprint
from gipkg.learning.config import TrainingConfig
from gipkg.learning.device import computes_in_bfloat16
from gipkg.learning.network import ViewClassifier
from gipkg.progress import progress

MOMENTUM = 0.9
WARM_UP = 0.1
SECONDS_BETWEEN_CHECKPOINTS = 20.0


def number_of_steps(config: TrainingConfig, views: int) -> int:
    """Count the steps of a training on that many views."""
    return max(config.minimum_steps, math.ceil(config.epochs * views / config.batch_size))


def learning_rate(config: TrainingConfig, done: float) -> float:
    """Return the learning rate when the share `done` in [0, 1) of the training is over."""
    if config.schedule == "steps":
        return config.learning_rate * 0.1 ** int(4 * done)
    if done < WARM_UP:
        return config.learning_rate * done / WARM_UP
    return config.learning_rate * 0.5 * (1 + math.cos(math.pi * (done - WARM_UP) / (1 - WARM_UP)))


def batches(samples: int, batch_size: int, seed: int, start: int) -> Iterator[NDArray[np.int64]]:
    """Yield the samples of every step from step `start` on: random permutations, end to end."""

    @lru_cache(maxsize=2)
    def permutation(epoch: int) -> NDArray[np.int64]:
        return np.random.default_rng([seed, epoch]).permutation(samples)

    position = start * batch_size
    while True:
        epochs, places = np.divmod(np.arange(position, position + batch_size), samples)
        yield np.concatenate([permutation(e)[places[epochs == e]] for e in np.unique(epochs)])
        position += batch_size


def drawn_views(
    samples: NDArray[np.int64], views: int, together: int, rng: np.random.Generator
) -> NDArray[np.int64]:
    """Return the views (N, together) of N samples, `views` being those of a shape.

    A sample is one view, or as many random ones of a shape; a shape makes views / together.
    """
    if together == 1:
        return samples[:, None]
    shapes = samples // (views // together)
    drawn = rng.permuted(np.tile(np.arange(views), (len(samples), 1)), axis=1)[:, :together]
    return shapes[:, None] * views + drawn


def make_optimiser(network: nn.Module, config: TrainingConfig) -> Optimizer:
    """Return the optimiser that the configuration names."""
    parameters, decay = network.parameters(), config.weight_decay
    if config.optimiser == "sgd":
        return SGD(parameters, momentum=MOMENTUM, lr=0.0, weight_decay=decay, fused=True)
    return AdamW(parameters, lr=0.0, weight_decay=decay, fused=True)


def train(
    network: ViewClassifier,
    views: Tensor,
    classes: Tensor,
    config: TrainingConfig,
    seed: int,
    checkpoint: Path | None = None,
) -> None:
    """Train a network in place, on its own device.

    Parameters
    ----------
    network : ViewClassifier
    views : (n, V, H, W, C) tensor
        V views of each of n shapes, in main memory, of a type that the network takes.
    classes : (n,) int64 tensor
        Class of every shape, in [0, k).
    config : TrainingConfig
    seed : int
        Of the order of the views and of dropout; the weights come as they are.
    checkpoint : Path, optional
        Where the state is kept; a training found there is continued.

    Raises
    ------
    LearningError
        There are fewer views of a shape than the network pools, or the training diverged.
    DamagedFileError
        The checkpoint cannot be read.
    """
    if views.shape[1] < network.together:
        raise LearningError(
            f"the network pools {network.together} views of a shape, there are {views.shape[1]}: "
            "lower together or make more views"
        )
    device = next(network.parameters()).device
    network.train()
    optimiser = make_optimiser(network, config)
    criterion = nn.CrossEntropyLoss(label_smoothing=config.label_smoothing)
    bfloat16 = computes_in_bfloat16(device, config.precision)
    store, start = None, 0
    if checkpoint is not None:
        how = f"{network.together} {config.model_dump_json()} {seed} {device.type} {bfloat16}"
        weights = [value.cpu() for value in network.state_dict().values()]
        store = Checkpoint(checkpoint, fingerprint(f"{network} {how}", classes, views, *weights))
        start = store.restore(network, optimiser, device)

    flat, (shapes, of_a_shape) = views.flatten(0, 1), views.shape[:2]
    together = network.together
    steps = number_of_steps(config, len(flat))
    # Batch normalisation needs two rows.
    batch = max(config.batch_size // together, 2)
    order = batches(shapes * (of_a_shape // together), batch, seed, start)
    saved = time.monotonic()
    for step in progress(range(start, steps), "training", done=start):
        random = np.random.SeedSequence([seed, step])
        shown = drawn_views(next(order), of_a_shape, together, np.random.default_rng(random))
        targets = classes[shown[:, 0] // of_a_shape]
        images = flat.index_select(0, torch.from_numpy(shown.ravel())).permute(0, 3, 1, 2)
        if config.mirror:
            # All views of a sample or none: a shape is never seen with some of its views mirrored.
            samples = images.unflatten(0, (-1, together))
            samples[::2] = samples[::2].transpose(-2, -1).clone()
        for group in optimiser.param_groups:
            group["lr"] = learning_rate(config, (step + 0.5) / steps)
        torch.manual_seed(int(random.generate_state(1, np.uint64)[0]))
        with torch.autocast(device.type, torch.bfloat16, enabled=bfloat16):
            scores, _ = network(images.to(device))
            loss = criterion(scores, targets.to(device))
        _descend(optimiser, loss, f"step {step} of {steps}")
        if store and time.monotonic() - saved >= SECONDS_BETWEEN_CHECKPOINTS:
            store.save(step + 1, network, optimiser)
            saved = time.monotonic()
    if store and start < steps:
        store.save(steps, network, optimiser)


def _descend(optimiser: Optimizer, loss: Tensor, where: str) -> None:
    """Take one step down the gradient of a finite loss."""
    if not torch.isfinite(loss):
        raise LearningError(
            f"training diverged at {where}: lower learning_rate; are all channels finite?"
        )
    optimiser.zero_grad()
    loss.backward()
    optimiser.step()
