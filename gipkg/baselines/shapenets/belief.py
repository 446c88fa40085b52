"""Convolutional restricted Boltzmann machines, stacked to a deep belief network.

Wu et al. (2015), Section 3. A machine gives visible units v and hidden units h in {0, 1} the energy

    E(v, h) = - Σ_f Σ_j h_fj ((W_f * v)_j + c_f) - Σ_i b_i v_i

with filters W_f and biases c_f, one a feature map f, and b_i, one a visible unit. Summed over h,
the free energy of v is -b·v - Σ softplus(W * v + c), and its gradient that of the likelihood.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import torch
from torch import Tensor, nn
from torch.nn.functional import avg_pool3d, conv_transpose3d, max_pool3d, pad, softplus


class BoltzmannMachine(nn.Module):
    """A convolutional restricted Boltzmann machine.

    A fully connected one has a filter as large as its input.

    Parameters
    ----------
    channels, size : int
        Its visible units are (B, channels, size, size, size).
    features, kernel, stride : int
        Feature maps, side of a filter, and stride. The filters have to fit without remainder.
    """

    scale: Tensor

    def __init__(self, channels: int, size: int, features: int, kernel: int, stride: int) -> None:
        super().__init__()
        self.convolution = nn.Conv3d(channels, features, kernel, stride)
        self.visible_bias = nn.Parameter(torch.zeros(channels, size, size, size))
        self.register_buffer("scale", torch.ones(()))
        self.kernel, self.stride = kernel, stride
        self.size = (size - kernel) // stride + 1
        nn.init.xavier_uniform_(self.convolution.weight)
        nn.init.zeros_(cast("Tensor", self.convolution.bias))

    def forward(self, visible: Tensor) -> Tensor:
        """Return the probabilities of the hidden units given the visible ones."""
        return torch.sigmoid(self.convolution(visible))

    def reconstruct(self, hidden: Tensor) -> Tensor:
        """Return the probabilities of the visible units given the hidden ones."""
        seen = spread(hidden, self.convolution.weight, self.stride)
        return torch.sigmoid(seen + self.visible_bias)

    @torch.no_grad()
    def start_from(self, data: Tensor) -> None:
        """Fit to a first batch what else would take many steps to learn, or a rate of its own.

        The visible units get the odds that they have in the batch, each seen once on and off.
        The scale is the mean squared norm of what a filter sees, where it sees anything, and of
        what a visible unit is seen by, at even odds.
        """
        data = data.float()
        odds = (data.sum(0) + 1) / (len(data) + 2)
        self.visible_bias.copy_(odds.logit())
        seen = avg_pool3d(data.square().sum(1), self.kernel, self.stride) * self.kernel**3
        features, size = self.convolution.out_channels, data.shape[-1]
        seen_by = features * (self.size * self.kernel / size) ** 3
        self.scale.copy_(seen[seen > 0].mean() + seen_by / 4)

    @torch.no_grad()
    def sample(self, hidden: Tensor, steps: int) -> Tensor:
        """Return the probabilities of the visible units after so many steps of Gibbs sampling.

        The first is from the hidden units of these probabilities.
        """
        visible = self.reconstruct(torch.bernoulli(hidden.float()))
        for _ in range(steps - 1):
            visible = self.reconstruct(torch.bernoulli(self(visible).float()))
        return visible

    def contrast(
        self, data: Tensor, activations: Tensor, sampled: Tensor, target: float, cost: float
    ) -> Tensor:
        """Return what the gradient of contrastive divergence is the gradient of.

        `activations` are the convolution of the data, which sampling has begun from. The contrast
        is the free energy of the data less that of the sample, in mean over the batch; the
        hidden units in mean over the places where a filter has any data under it, since most of
        a grid of voxels is empty; the visible ones over a side of a feature map. `cost` draws
        the mean activation of every feature map towards `target` by its bias. All is divided by
        the scale: a step that is short enough for a few units is too long for many.
        """
        places = max_pool3d(data.amax(1, keepdim=True), self.kernel, self.stride) > 0
        difference = softplus(activations) - softplus(self.convolution(sampled))
        number = places.sum()
        hidden = (difference * places).sum() / number
        visible = (self.visible_bias * (data - sampled).mean(0)).sum() / self.size
        active = (activations.detach().sigmoid() * places).sum((0, 2, 3, 4)) / number
        sparsity = cost * (cast("Tensor", self.convolution.bias) * (active - target)).sum()
        return (sparsity - hidden - visible) / self.scale


def spread(hidden: Tensor, weight: Tensor, stride: int) -> Tensor:
    """Return the transposed convolution ``conv_transpose3d(hidden, weight, stride=stride)``.

    It is taken without a stride, to all the voxels of a block at once as channels: on processors
    several times as fast.

    Parameters
    ----------
    hidden : (B, F, n, n, n) tensor
    weight : (F, C, k, k, k) tensor
    stride : int

    Returns
    -------
    (B, C, m, m, m) tensor, m = (n - 1) stride + k
    """
    (features, channels, kernel), n = weight.shape[:3], hidden.shape[-1]
    blocks = -(-kernel // stride)
    filled = pad(weight, (0, blocks * stride - kernel) * 3)
    split = filled.view(features, channels, *(blocks, stride) * 3).permute(0, 1, 3, 5, 7, 2, 4, 6)
    seen = conv_transpose3d(hidden, split.reshape(features, -1, blocks, blocks, blocks))
    seen = seen.view(len(hidden), channels, *(stride,) * 3, *(n + blocks - 1,) * 3)
    side = (n + blocks - 1) * stride
    seen = seen.permute(0, 1, 5, 2, 6, 3, 7, 4).reshape(len(hidden), channels, side, side, side)
    size = (n - 1) * stride + kernel
    return seen[..., :size, :size, :size]


class BeliefNetwork(nn.Module):
    """Machines, the hidden units of each of which are the visible ones of the next.

    Parameters
    ----------
    size : int
        Voxels along a side of the grid.
    maps : sequence of (features, kernel, stride)
        Of the convolutional machines.
    widths : sequence of int
        Numbers of hidden units of the fully connected ones.
    """

    def __init__(
        self, size: int, maps: Sequence[tuple[int, int, int]], widths: Sequence[int]
    ) -> None:
        super().__init__()
        self.machines = nn.ModuleList()
        channels = 1
        for features, kernel, stride in maps:
            self.machines.append(BoltzmannMachine(channels, size, features, kernel, stride))
            channels, size = features, (size - kernel) // stride + 1
        for width in widths:
            self.machines.append(BoltzmannMachine(channels, size, width, size, 1))
            channels, size = width, 1

    @torch.no_grad()
    def below(self, depth: int, visible: Tensor) -> Tensor:
        """Return the probabilities that the machine at a depth sees."""
        for machine in self.machines[:depth]:
            visible = machine(visible)
        return visible
