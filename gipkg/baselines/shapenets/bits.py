"""Grids of voxels as bits, eight a byte: what many rotations of many shapes have room in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from torch import Tensor


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
        The packed axis first, as in the images.
    """
    import torch

    eights = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1).astype(np.float32)
    rows = images.permute(0, 2, 3, 1)
    bits = torch.from_numpy(eights).to(images.device).index_select(0, rows.flatten().int())
    grids = bits.view(len(images), 1, size, size, -1)[..., :size]
    return grids.permute(0, 1, 4, 2, 3).contiguous()
