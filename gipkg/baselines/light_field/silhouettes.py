"""Silhouettes of a mesh as pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled

SIZE = 256
"""Pixels along a side of an image."""
MARGIN = 2
"""Pixels that stay empty along the border, so that every outline is closed."""


def silhouette(corners: NDArray[np.float64], direction: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Draw the orthographic silhouette of a closed, oriented surface inside the unit ball.

    A pixel belongs to it if a face touches its square, so that a connected surface, however
    thin, has a connected silhouette. Faces turned one way are drawn, since those turned the
    other way lie behind or before them.

    Parameters
    ----------
    corners : (F, 3, 3) float64 array
        Corners of the faces.
    direction : (3,) float64 array
        Unit vector towards the camera; how the image is turned about it is arbitrary.

    Returns
    -------
    (SIZE, SIZE) bool array
    """
    across = np.eye(3)[np.abs(direction).argmin()]
    right = np.cross(direction, across)
    right /= np.linalg.norm(right)
    plane = np.stack([np.cross(direction, right), right], axis=1)
    image = np.zeros((SIZE, SIZE), dtype=np.bool_)
    _fill(image, (corners @ plane) * (SIZE / 2 - MARGIN) + SIZE / 2)
    return image


@compiled
def _fill(image, triangles):  # type: ignore[no-untyped-def]
    """Mark the unit squares [i, i + 1] x [j, j + 1] that the triangles (F, 3, 2) touch."""
    edges = np.empty((3, 3))
    for f in range(len(triangles)):
        x, y = triangles[f, :, 0], triangles[f, :, 1]
        if (x[1] - x[0]) * (y[2] - y[0]) < (x[2] - x[0]) * (y[1] - y[0]):
            continue
        for k in range(3):
            following = (k + 1) % 3
            a, b = y[k] - y[following], x[following] - x[k]
            # The half plane to the inner side of the edge, moved out by half a square.
            edges[k, 0], edges[k, 1] = a, b
            edges[k, 2] = (abs(a) + abs(b)) / 2 - a * x[k] - b * y[k]
        for i in range(int(x.min()), int(x.max()) + 1):
            for j in range(int(y.min()), int(y.max()) + 1):
                touched = True
                for k in range(3):
                    centre = edges[k, 0] * (i + 0.5) + edges[k, 1] * (j + 0.5)
                    touched = touched and centre + edges[k, 2] >= 0
                if touched:
                    image[i, j] = True
