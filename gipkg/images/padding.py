"""Continue an image beyond its border by its own symmetry."""

from __future__ import annotations

from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray


class Indexable(Protocol):
    """What is needed of NumPy arrays and torch tensors alike, without importing torch."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of the axes, the last two rows and columns."""
        ...

    def __getitem__(self, index: Any, /) -> Any: ...


Images = TypeVar("Images", bound=Indexable)


def pad(images: Images, margin: int) -> Images:
    """Continue images over the cut, onto the surface on its other side.

    Across a side lies the same image turned by 180° about the side's midpoint, across a
    corner (the south pole, where all four corners meet) the opposite corner's neighbourhood
    (paper, section 4.2). A side's pixels are shared with its replica and not repeated.

    Parameters
    ----------
    images : (..., n, n) array or tensor
    margin : int
        Pixels to add at each side, 0 to n - 1.

    Returns
    -------
    (..., n + 2 margin, n + 2 margin) array or tensor, of the kind given

    Raises
    ------
    ValueError
        The margin is negative, or not below n.
    """
    rows, columns = padding_indices(images.shape[-1], margin)
    return images[..., rows, columns]


def padding_indices(size: int, margin: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row and column, within the image, of every pixel of the padded image.

    Returns
    -------
    rows, columns : (size + 2 margin, size + 2 margin) int64 arrays

    Raises
    ------
    ValueError
        The margin is negative, or not below the size.
    """
    if not 0 <= margin < size:
        raise ValueError(f"margin is {margin}, it must be 0 to {size - 1} for {size} pixels")
    last = size - 1
    position = np.arange(-margin, size + margin)
    outside = (position < 0) | (position > last)
    folded = last - np.abs(last - np.abs(position))
    # Crossing a top or bottom side reverses the columns, crossing a left or right one the rows.
    rows = np.where(outside[None, :], last - folded[:, None], folded[:, None])
    columns = np.where(outside[:, None], last - folded[None, :], folded[None, :])
    return rows, columns
