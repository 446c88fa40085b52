"""All figures of one prediction: how well it classifies and how well it retrieves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gipkg.evaluation.classification import accuracy
from gipkg.evaluation.retrieval import mean_average_precision, precision_recall
from gipkg.learning.prediction import Prediction


@dataclass(frozen=True, slots=True)
class Scores:
    """Figures of one split.

    Attributes
    ----------
    accuracy : float
        Share of the test part that is classified correctly.
    mean_average_precision : float
        Over the test shapes that were predicted.
    precision : list of 11 floats
        Mean precision at the recall levels 0, 0.1, …, 1, over the same shapes.
    tested : int
        Shapes in the test part.
    missing : list of str
        Those of them without a prediction, since an earlier stage failed on them.
    """

    accuracy: float
    mean_average_precision: float
    precision: list[float]
    tested: int
    missing: list[str]


def score(prediction: Prediction, truth: Mapping[str, str]) -> Scores:
    """Score the prediction of a test part.

    Parameters
    ----------
    prediction : Prediction
    truth : mapping of shape id to class
        The whole test part. A shape that was not predicted counts as misclassified, so that
        a method gains nothing by failing on hard shapes; retrieval cannot rank it and leaves
        it out.

    Raises
    ------
    ValueError
        No shape was predicted, no two of one class were, or distances are not finite.
    """
    column = {name: index for index, name in enumerate(prediction.classes)}
    labels = [truth[shape_id] for shape_id in prediction.ids]
    # A class that no training shape has is in no column, and is never predicted.
    correct = accuracy(prediction.scores, [column.get(label, -1) for label in labels])
    distances = prediction.pairwise_distances()
    return Scores(
        accuracy=correct * len(labels) / len(truth),
        mean_average_precision=mean_average_precision(distances, labels),
        precision=precision_recall(distances, labels).tolist(),
        tested=len(truth),
        missing=sorted(set(truth) - set(prediction.ids)),
    )
