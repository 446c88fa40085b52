"""Which pixels of an image are one point of the sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def canonical_pixels(size: int) -> NDArray[np.int64]:
    """For every pixel, the first pixel in reading order that shows the same point.

    Each side of the image is folded at its middle along the cut, and the four corners are
    the south pole; every pixel inside stands for itself.

    Parameters
    ----------
    size : int
        Rows and columns n of the image, at least 3.

    Returns
    -------
    (n, n) int64 array
        Flat indices ``row * n + column``.

    Raises
    ------
    ValueError
        The image has fewer than 3 x 3 pixels.
    """
    if size < 3:
        raise ValueError(f"a geometry image needs at least 3 x 3 pixels, not {size} x {size}")
    rows, columns = np.indices((size, size))
    on_row_side = (rows == 0) | (rows == size - 1)
    on_column_side = (columns == 0) | (columns == size - 1)
    folded_rows = np.where(on_column_side, np.minimum(rows, size - 1 - rows), rows)
    folded_columns = np.where(on_row_side, np.minimum(columns, size - 1 - columns), columns)
    return folded_rows * size + folded_columns
