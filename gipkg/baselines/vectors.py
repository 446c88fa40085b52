"""Baselines whose representation is a vector: a linear classifier, and the L2 distance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from gipkg.api import Baseline
from gipkg.baselines.svm import classify

if TYPE_CHECKING:
    from pathlib import Path

    from gipkg.learning.prediction import Prediction


class VectorBaseline(Baseline):
    """A baseline that represents every shape as a (D,) float64 array."""

    def predict(
        self,
        representations: Mapping[str, NDArray[Any]],
        train: Mapping[str, str],
        test: Sequence[str],
        *,
        seed: int = 0,
        device: str = "auto",
        checkpoint: Path | None = None,
    ) -> Prediction:
        """Classify by a linear support vector machine; embeddings are the vectors.

        `device` and `checkpoint` are not used.
        """
        return classify(representations, train, test, seed=seed)
