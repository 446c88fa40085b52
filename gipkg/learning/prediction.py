"""What a classifier says about shapes; the same for networks and baselines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Prediction:
    """Class scores and signatures of n shapes.

    Attributes
    ----------
    ids : tuple of n str
        The shapes, in the order asked for.
    classes : tuple of k str
        The classes of the training part, sorted.
    scores : (n, k) float32 array
        The highest of a row is the class predicted.
    embeddings : (n, d) float32 array
        Signatures of the shapes.
    distances : (n, n) float32 array, optional
        From every shape, a row, to every shape, where a method has a distance of its own;
        the L2 distance of the embeddings otherwise.

    Raises
    ------
    ValueError
        At construction if the arrays do not fit together.
    """

    ids: tuple[str, ...]
    classes: tuple[str, ...]
    scores: NDArray[np.float32]
    embeddings: NDArray[np.float32]
    distances: NDArray[np.float32] | None = None

    def __post_init__(self) -> None:
        n, k = len(self.ids), len(self.classes)
        if self.scores.shape != (n, k):
            raise ValueError(f"scores of {n} shapes, {k} classes: {self.scores.shape}")
        if self.embeddings.ndim != 2 or len(self.embeddings) != n:
            raise ValueError(f"embeddings of {n} shapes: {self.embeddings.shape}")
        if self.distances is not None and self.distances.shape != (n, n):
            raise ValueError(f"distances between {n} shapes: {self.distances.shape}")

    def pairwise_distances(self) -> NDArray[np.float64]:
        """Return what retrieval ranks by, (n, n): a row for every query."""
        if self.distances is not None:
            return self.distances.astype(np.float64)
        from scipy.spatial.distance import cdist

        embeddings = self.embeddings.astype(np.float64)
        return cdist(embeddings, embeddings)
