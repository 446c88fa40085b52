"""Classification: one prediction a shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def accuracy(scores: ArrayLike, labels: ArrayLike) -> float:
    """Share of the shapes whose highest score is that of their own class.

    Parameters
    ----------
    scores : (n, k) array_like
        Score of each class for each shape, views pooled already.
    labels : (n,) array_like of int
        Column of each shape's class. Of equal highest scores, the first column is predicted.

    Returns
    -------
    float
        In [0, 1].

    Raises
    ------
    ValueError
        There are no shapes, or not as many scores as labels.
    """
    scores, labels = np.asarray(scores), np.asarray(labels)
    if scores.ndim != 2 or labels.shape != scores.shape[:1] or not len(labels):
        raise ValueError(
            f"scores must be (n, k) and labels (n,) with n > 0; got {scores.shape}, {labels.shape}"
        )
    return float(np.mean(scores.argmax(axis=1) == labels))
