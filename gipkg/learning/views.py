"""Geometry images as the network takes them: scaled, padded, in its memory layout."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from gipkg.images.padding import padding_indices


@dataclass(frozen=True)
class Layout:
    """Raw geometry images to padded views with the channels last.

    Attributes
    ----------
    margin : int
        Pixels of padding on each side.
    permutation : (n * n,) int64 array or None
        New order of the pixels of every image: the control of a shuffled layout.

    Raises
    ------
    ValueError
        At the first image that is no larger than the margin.
    """

    margin: int
    permutation: NDArray[np.int64] | None = None

    def __call__(self, images: Tensor) -> Tensor:
        """Lay out the (V, C, n, n) images of one shape as (V, n + 2m, n + 2m, C) views."""
        taken = self.taken(images.shape[-1])
        # Channels are moved before the pixels are, so that these are copied a run at a time.
        pixels = images.flatten(2).transpose(1, 2).contiguous()
        return pixels.index_select(1, taken.flatten()).unflatten(1, taken.shape)

    def taken(self, size: int) -> Tensor:
        """Return the pixel, in [0, n * n), that is seen at each place of a view."""
        rows, columns = padding_indices(size, self.margin)
        pixels = rows * size + columns
        return torch.from_numpy(pixels if self.permutation is None else self.permutation[pixels])


@dataclass(frozen=True)
class Scale:
    """An affine change of every channel.

    Attributes
    ----------
    mean, deviation : (C,) or (1,) float64 tensor
        Subtracted from the channels, then divided by.
    """

    mean: Tensor
    deviation: Tensor

    def __call__(self, images: Tensor) -> Tensor:
        """Scale (..., C, n, n) images to float32, in float64 so that no range is lost."""
        mean, deviation = self.mean[:, None, None], self.deviation[:, None, None]
        return images.to(torch.float64, copy=True).sub_(mean).div_(deviation).float()


def views_of(
    images: NDArray[np.float32],
    layout: Layout,
    scale: Scale,
    precision: torch.dtype = torch.float32,
) -> Tensor:
    """Scale and lay out the (V, C, n, n) images of one shape as a (V, H, W, C) tensor."""
    return layout(scale(_tensor(images)).to(precision))


def stack(
    images: Mapping[str, NDArray[np.float32]],
    ids: Sequence[str],
    layout: Layout,
    scale: Scale,
    precision: torch.dtype,
) -> Tensor:
    """Read, scale and lay out the images of shapes, one by one, as an (n, V, H, W, C) tensor.

    Values of mean 0 and deviation 1 lose nothing in half a precision that a training would
    notice, and take half of the memory, of which a training part needs the most.
    """
    first = views_of(images[ids[0]], layout, scale, precision)
    views = torch.empty((len(ids), *first.shape), dtype=precision)
    views[0] = first
    for i, shape_id in enumerate(ids[1:], start=1):
        views[i] = views_of(images[shape_id], layout, scale, precision)
    return views


def fit_scale(
    images: Mapping[str, NDArray[np.float32]], ids: Sequence[str], layout: Layout, jointly: bool
) -> Scale:
    """Give every channel of the shapes' views mean 0 and deviation 1; a constant one 0.

    Jointly, all channels are taken for one and keep their proportions.
    """
    channels, size = images[ids[0]].shape[1:3]
    # What a pixel weighs is how often it is seen: no view has to be laid out.
    seen = torch.bincount(layout.taken(size).flatten(), minlength=size**2)
    weights = seen.double() / seen.sum()
    groups = 1 if jointly else channels
    # Filled in place: small results kept one by one would fragment the memory of the large ones.
    means, variances = torch.zeros((2, len(ids), groups), dtype=torch.float64)
    for i, shape_id in enumerate(ids):
        values = _tensor(images[shape_id]).double().reshape(-1, groups, size**2)
        # Relative to the first pixel, so that a constant channel deviates by exactly nothing.
        first = values[0, :, :1].clone()
        offset = (values.sub_(first) @ weights).mean(0)
        means[i] = first[:, 0] + offset
        variances[i] = (values.sub_(offset[:, None]).square_() @ weights).mean(0)
    # Variance within the shapes plus variance between them, all shapes being of one size.
    deviation = (variances.mean(0) + means.var(0, correction=0)).sqrt()
    return Scale(means.mean(0), torch.where(deviation > 0, deviation, 1.0))


def _tensor(images: NDArray[np.float32]) -> Tensor:
    return torch.from_numpy(images.astype(np.float32, copy=False))
