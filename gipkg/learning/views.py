"""Geometry images as the network takes them: padded, in its memory layout, scaled."""

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
    """

    margin: int
    permutation: NDArray[np.int64] | None = None

    def __call__(self, images: NDArray[np.float32]) -> NDArray[np.float32]:
        """Lay out the (V, C, n, n) images of one shape as (V, n + 2m, n + 2m, C) views."""
        count, channels, size, _ = images.shape
        rows, columns = padding_indices(size, self.margin)
        taken = rows * size + columns
        if self.permutation is not None:
            taken = self.permutation[taken]
        # Channels are moved before the pixels are, so that these are copied a run at a time.
        pixels = np.ascontiguousarray(np.moveaxis(images.reshape(count, channels, -1), 1, 2))
        return np.take(pixels, taken, axis=1)


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

    def __call__(self, views: Tensor) -> Tensor:
        """Scale (..., C) views to float32, in float64 so that no range of values is lost."""
        return (views.double() - self.mean).div_(self.deviation).float()


def views_of(images: NDArray[np.float32], layout: Layout) -> Tensor:
    """Lay out the images of one shape as a (V, H, W, C) float32 tensor."""
    return torch.from_numpy(layout(images).astype(np.float32, copy=False))


def stack(
    images: Mapping[str, NDArray[np.float32]], ids: Sequence[str], layout: Layout, scale: Scale
) -> Tensor:
    """Read and scale the images of shapes, one by one, as an (n, V, H, W, C) float16 tensor.

    Values of mean 0 and deviation 1 lose nothing that a training would notice, and take half of
    the memory, of which a training part needs the most.
    """
    first = scale(views_of(images[ids[0]], layout))
    views = torch.empty((len(ids), *first.shape), dtype=torch.float16)
    views[0] = first
    for i, shape_id in enumerate(ids[1:], start=1):
        views[i] = scale(views_of(images[shape_id], layout))
    return views


def fit_scale(
    images: Mapping[str, NDArray[np.float32]], ids: Sequence[str], layout: Layout, jointly: bool
) -> Scale:
    """Give every channel of the shapes' views mean 0 and deviation 1; a constant one 0.

    Jointly, all channels are taken for one and keep their proportions.
    """
    channels = 1 if jointly else images[ids[0]].shape[1]
    # Filled in place: small results kept one by one would fragment the memory of the large ones.
    means, variances = torch.zeros((2, len(ids), channels), dtype=torch.float64)
    for i, shape_id in enumerate(ids):
        values = views_of(images[shape_id], layout).reshape(-1, channels).double()
        # Relative to the first pixel, so that a constant channel deviates by exactly nothing.
        first = values[0].clone()
        offset = values.sub_(first).mean(0)
        means[i] = first + offset
        variances[i] = values.sub_(offset).square_().mean(0)
    # Variance within the shapes plus variance between them, all shapes being of one size.
    deviation = (variances.mean(0) + means.var(0, correction=0)).sqrt()
    return Scale(means.mean(0), torch.where(deviation > 0, deviation, 1.0))
