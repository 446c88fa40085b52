"""A tiny set of images: smooth fields on the square, one pattern a class, in several views."""

from __future__ import annotations

import numpy as np
import scipy.ndimage
from numpy.typing import NDArray

Images = dict[str, NDArray[np.float32]]

CLASSES, VIEWS, CHANNELS, SIZE = 3, 4, 2, 40


def synthetic_images(shapes: int, noise: float = 0.3) -> tuple[Images, dict[str, str]]:
    """Images (VIEWS, CHANNELS, SIZE, SIZE) and class of shapes s0, s1, …, classes in turn."""
    rng = np.random.default_rng(0)

    def fields(*count: int) -> NDArray[np.float64]:
        smooth = scipy.ndimage.gaussian_filter(
            rng.normal(size=(*count, SIZE, SIZE)), 4, axes=(-2, -1)
        )
        return smooth / smooth.std()

    patterns = fields(CLASSES, CHANNELS)
    units = np.array([1e-3, 1e4])[:, None, None]  # channels of very different scale
    images, labels = {}, {}
    for i in range(shapes):
        views = patterns[i % CLASSES] + noise * fields(VIEWS, CHANNELS)
        images[f"s{i}"] = (units * (views + 5)).astype(np.float32)
        labels[f"s{i}"] = f"class {i % CLASSES}"
    return images, labels
