"""How large images are on their way through a network: plain arithmetic, without torch."""

from __future__ import annotations

from gipkg.errors import LearningError
from gipkg.learning.config import NetworkConfig

FIRST_KERNEL, KERNEL = 5, 3
FIRST_STRIDE = 2
POOL = 2


def padded_size(config: NetworkConfig, size: int) -> int:
    """Side of the square that a network is given for images of side `size`: 64 for 56 by default.

    Raises
    ------
    LearningError
        The margin is no smaller than the image.
    """
    if config.margin >= size:
        raise LearningError(
            f"images of {size} pixels a side cannot be continued by a margin of {config.margin}: "
            "use larger images or a narrower margin"
        )
    return size + 2 * config.margin


def feature_map_size(config: NetworkConfig, size: int) -> int:
    """Side of the last feature map for square inputs of side `size`: 2 for 64 by default.

    Raises
    ------
    LearningError
        Nothing is left of so small an image.
    """
    side, kernel, stride = size, FIRST_KERNEL, FIRST_STRIDE
    for number, block in enumerate(config.blocks):
        for _ in block:
            side = (side - kernel) // stride + 1
            kernel, stride = KERNEL, 1
        if is_pooled_locally(config, number):
            side //= POOL
        if side < 1:
            raise LearningError(
                f"images of {size} pixels a side, padding included, are too small for the "
                "network: use larger images, a wider margin or fewer blocks"
            )
    return side


def is_pooled_locally(config: NetworkConfig, block: int) -> bool:
    """Whether pixels are pooled two by two after the block of that number."""
    return config.pooling == "local" or block < len(config.blocks) - 1
