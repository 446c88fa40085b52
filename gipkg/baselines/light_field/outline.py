"""The outline of a silhouette and its Fourier descriptors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled

SAMPLES = 256
"""Points of the outline, at equal distances along it."""


def trace(image: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Walk around the outline of a connected silhouette; (P, 2) pixels, P at least 1.

    Every step goes to one of eight neighbours, and the last pixel is a neighbour of the first.
    Pixels along the border of the image must be empty.
    """
    first = int(image.argmax())
    row, column = divmod(first, image.shape[1])
    return np.stack(np.divmod(_walk(image, row, column), image.shape[1]), axis=1)


def resample(outline: NDArray[np.int64], count: int) -> NDArray[np.float64]:
    """Return points (count, 2) at equal distances along a closed outline."""
    closed = np.vstack([outline, outline[:1]]).astype(np.float64)
    steps = np.linalg.norm(np.diff(closed, axis=0), axis=1)
    places = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.linspace(0, places[-1], count, endpoint=False)
    return np.stack([np.interp(wanted, places, axis) for axis in closed.T], axis=1)


def length(points: NDArray[np.float64]) -> float:
    """Return the length of the closed polygon through (P, 2) points."""
    return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


def fourier_descriptors(
    outline: NDArray[np.int64], centre: NDArray[np.float64], count: int
) -> NDArray[np.float64]:
    """Transform the distance of the outline from a centre; magnitudes beside the mean, (count,).

    Zhang & Lu, "A comparative study of Fourier descriptors for shape representation and
    retrieval", ACCV 2002. Neither a motion nor a size nor the first pixel matters.
    """
    distances = np.linalg.norm(resample(outline, SAMPLES) - centre, axis=1)
    magnitudes = np.abs(np.fft.rfft(distances))
    if magnitudes[0] == 0:  # A single pixel.
        return np.zeros(count)
    return magnitudes[1 : count + 1] / magnitudes[0]


@compiled
def _walk(image, row, column):  # type: ignore[no-untyped-def]
    """Return the pixels passed, by number, from the first one of the first row that has any."""
    rows = (-1, -1, 0, 1, 1, 1, 0, -1)  # clockwise from the one above
    columns = (0, 1, 1, 1, 0, -1, -1, -1)
    outline = [row * image.shape[1] + column]
    i, j, heading, first = row, column, 2, -1
    while True:
        # Clockwise from what is known to be empty: the outside stays to the left.
        found = -1
        for turn in range(8):
            k = (heading + 6 + turn) % 8
            if image[i + rows[k], j + columns[k]]:
                found = k
                break
        if found < 0:  # A single pixel.
            break
        if i == row and j == column:
            if found == first:
                outline.pop()
                break
            if first < 0:
                first = found
        i, j, heading = i + rows[found], j + columns[found], found
        outline.append(i * image.shape[1] + j)
    return np.array(outline)
