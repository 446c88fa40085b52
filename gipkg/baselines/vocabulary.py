"""A vocabulary of point signatures: what bags of words are counted in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256

import numpy as np
from numpy.typing import NDArray

POINTS = 200
"""Points of a training shape, drawn by area, that the vocabulary is learned from."""
RESTARTS = 4


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Words in signature space and how points are assigned to them.

    Attributes
    ----------
    mean, deviation : (C,) float64 arrays
        Of the training points; signatures are standardised by them.
    words : (W, C) float64 array
        In standardised units.
    sigma : float
        Standard deviation of the assignment, likewise.
    """

    mean: NDArray[np.float64]
    deviation: NDArray[np.float64]
    words: NDArray[np.float64]
    sigma: float

    def assign(self, signatures: NDArray[np.float64]) -> NDArray[np.float64]:
        """Assign (V, C) signatures softly to the words; (V, W), every row sums to 1."""
        from scipy.spatial.distance import cdist

        squares = cdist((signatures - self.mean) / self.deviation, self.words, "sqeuclidean")
        # Relative to the nearest word, or a point far from all of them would underflow.
        weights = np.exp(-(squares - squares.min(axis=1, keepdims=True)) / (2 * self.sigma**2))
        return weights / weights.sum(axis=1, keepdims=True)


def learn_vocabulary(
    points: Mapping[str, NDArray[np.float64]], words: int, softness: float, seed: int
) -> Vocabulary:
    """Cluster points of the training shapes by k-means.

    Parameters
    ----------
    points : mapping of shape id to (V, 1 + C) array
        Shares of the area, then signatures.
    words : int
        Size of the vocabulary.
    softness : float
        σ in units of the median radius, the root mean square distance of a cluster's points
        from its word.
    seed : int
        Of the points drawn and of the clustering.
    """
    from sklearn.cluster import KMeans

    drawn = np.concatenate([_draw(shape_id, rows, seed) for shape_id, rows in points.items()])
    mean, deviation = drawn.mean(axis=0), drawn.std(axis=0)
    deviation = np.where(deviation > 0, deviation, 1.0)
    drawn = (drawn - mean) / deviation
    clusters = KMeans(words, n_init=RESTARTS, random_state=seed).fit(drawn)
    squares = ((drawn - clusters.cluster_centers_[clusters.labels_]) ** 2).sum(axis=1)
    members = np.bincount(clusters.labels_, minlength=words)
    radii = np.sqrt(np.bincount(clusters.labels_, squares, words) / np.maximum(members, 1))
    # Fewer different points than words leave clusters of radius 0.
    sigma = softness * float(np.median(radii)) or 1.0
    return Vocabulary(mean, deviation, clusters.cluster_centers_, sigma)


def _draw(shape_id: str, rows: NDArray[np.float64], seed: int) -> NDArray[np.float64]:
    digest = int.from_bytes(sha256(shape_id.encode()).digest()[:8])
    rng = np.random.default_rng([seed, digest])
    chosen = rng.choice(len(rows), POINTS, p=rows[:, 0] / rows[:, 0].sum())
    return rows[chosen, 1:]
