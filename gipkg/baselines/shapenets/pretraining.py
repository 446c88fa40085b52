"""Contrastive divergence, machine by machine."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
import torch
from torch import Tensor
from torch.optim import SGD

from gipkg.baselines.shapenets.belief import BeliefNetwork, BoltzmannMachine
from gipkg.baselines.shapenets.bits import unpack
from gipkg.errors import LearningError
from gipkg.learning.checkpoint import Checkpoint, fingerprint
from gipkg.learning.device import computes_in_bfloat16
from gipkg.learning.training import SECONDS_BETWEEN_CHECKPOINTS, batches
from gipkg.progress import progress

BATCH_SIZE = 32
MOMENTUM = (0.5, 0.9)
"""In the first quarter of the steps of a machine, and then."""
WEIGHT_DECAY = 1e-5
SPARSITY = ((0.01, 0.001), (0.02, 0.002))
"""Target and cost for the first machines; the others have none."""


@dataclass(frozen=True)
class Pretraining:
    """How a belief network is pre-trained.

    Attributes
    ----------
    epochs : float
        Passes over all grids, for each machine.
    minimum_steps : int
        Least number of steps, for each machine.
    learning_rate : float
    gibbs_steps : int
        From the data to the sample it is held against.
    """

    epochs: float
    minimum_steps: int
    learning_rate: float
    gibbs_steps: int


def pretrain(
    belief: BeliefNetwork,
    views: Tensor,
    size: int,
    config: Pretraining,
    seed: int,
    checkpoint: Path | None = None,
) -> None:
    """Pre-train a belief network in place, on its own device, from the lowest machine up.

    Parameters
    ----------
    belief : BeliefNetwork
    views : (n, V, size, size, C) uint8 tensor
        Packed grids of V views of n shapes.
    size : int
        Voxels along a side.
    config : Pretraining
    seed : int
        Of the order of the views and of sampling; the weights come as they are.
    checkpoint : Path, optional
        Where the state is kept; a pre-training found there is continued.

    Raises
    ------
    LearningError
        The pre-training diverged.
    DamagedFileError
        The checkpoint cannot be read.
    """
    device = next(belief.parameters()).device
    bfloat16 = computes_in_bfloat16(device, "auto")
    optimiser = SGD(belief.parameters(), lr=config.learning_rate, weight_decay=WEIGHT_DECAY)
    store, start = None, 0
    if checkpoint is not None:
        description = f"{belief} {config} {seed} {device.type} {bfloat16}"
        weights = [value.cpu() for value in belief.state_dict().values()]
        store = Checkpoint(checkpoint, fingerprint(description, views, *weights))
        start = store.restore(belief, optimiser, device)

    flat = views.flatten(0, 1)
    each = max(config.minimum_steps, math.ceil(config.epochs * len(flat) / BATCH_SIZE))
    steps = each * len(belief.machines)
    order = batches(len(flat), BATCH_SIZE, seed, start)
    saved = time.monotonic()
    for step in progress(range(start, steps), "pre-training", done=start):
        depth, done = divmod(step, each)
        optimiser.param_groups[0]["momentum"] = MOMENTUM[4 * done >= each]
        images = flat[torch.from_numpy(next(order))].permute(0, 3, 1, 2).to(device)
        torch.manual_seed(int(np.random.SeedSequence([seed, step]).generate_state(1, np.uint64)[0]))
        with torch.autocast(device.type, torch.bfloat16, enabled=bfloat16):
            data = belief.below(depth, unpack(images, size))
            machine = cast("BoltzmannMachine", belief.machines[depth])
            if done == 0:
                machine.start_from(data)
            target, cost = SPARSITY[depth] if depth < len(SPARSITY) else (0.0, 0.0)
            activations = machine.convolution(data)
            if not torch.isfinite(activations.detach().sum()):
                raise LearningError("pre-training diverged: lower pretraining_rate")
            sampled = machine.sample(activations.detach().sigmoid(), config.gibbs_steps)
            loss = machine.contrast(data, activations, sampled, target, cost)
        _descend(optimiser, loss)
        if store and time.monotonic() - saved >= SECONDS_BETWEEN_CHECKPOINTS:
            store.save(step + 1, belief, optimiser)
            saved = time.monotonic()
    if store and start < steps:
        store.save(steps, belief, optimiser)


def _descend(optimiser: SGD, loss: Tensor) -> None:
    """Take one step; only the machine that the loss is of has a gradient and moves."""
    optimiser.zero_grad()
    loss.backward()
    optimiser.step()
