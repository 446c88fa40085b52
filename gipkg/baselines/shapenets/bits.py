"""Grids of voxels as bits, eight a byte: what many rotations of many shapes have room in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from torch import Tensor

_PLACES = 7, 6, 5, 4, 3, 2, 1, 0


def pack(grids: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Pack (..., n) truth values along the last axis: (..., ⌈n / 8⌉)."""
    return np.packbits(grids, axis=-1)


def unpack(images: Tensor, size: int) -> Tensor:
    """Return packed grids, the packed axis first, as numbers 0 and 1.

    Parameters
    ----------
    images : (B, ⌈n / 8⌉, n, n) uint8 tensor
    size : int
        Voxels along a side, n.

    Returns
    -------
    (B, 1, n, n, n) float32 tensor
    """
    import torch

    places = torch.tensor(_PLACES, device=images.device).view(8, 1, 1)
    bits = (images.unsqueeze(2).int() >> places) & 1
    return bits.flatten(1, 2)[:, None, :size].float()
