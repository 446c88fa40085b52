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
        Signatures, which retrieval compares by the L2 distance.
    """

    ids: tuple[str, ...]
    classes: tuple[str, ...]
    scores: NDArray[np.float32]
    embeddings: NDArray[np.float32]
