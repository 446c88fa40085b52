from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gipkg.evaluation.scores import score
from gipkg.learning.prediction import Prediction


def predict(predicted: dict[str, str], position: dict[str, float]) -> Prediction:
    """Predict a class for every shape, and put it at a place on a line."""
    classes = tuple(sorted(set(predicted.values())))
    scores = np.array([[name == one for name in classes] for one in predicted.values()])
    embeddings = np.array([[position[shape_id]] for shape_id in predicted])
    return Prediction(
        tuple(predicted), classes, scores.astype(np.float32), embeddings.astype(np.float32)
    )


TRUTH = {"a1": "a", "a2": "a", "b1": "b", "b2": "b"}
APART = {"a1": 0.0, "a2": 1.0, "b1": 10.0, "b2": 11.0}


def test_a_perfect_prediction() -> None:
    scores = score(predict(TRUTH, APART), TRUTH)
    assert scores.accuracy == 1.0
    assert scores.mean_average_precision == 1.0
    assert scores.precision == [1.0] * 11
    assert (scores.tested, scores.missing) == (4, [])


def test_one_of_four_wrong_and_the_kinds_interleaved() -> None:
    prediction = predict({**TRUTH, "b1": "a"}, {"a1": 0.0, "b1": 1.0, "a2": 3.0, "b2": 7.0})
    scores = score(prediction, TRUTH)
    assert scores.accuracy == 0.75
    # Rank of the one relevant shape: a2 seen from a1, b2 from b1, a1 from a2, b1 from b2.
    assert scores.mean_average_precision == pytest.approx(np.mean([1 / 2, 1 / 3, 1 / 2, 1 / 2]))


def test_a_distance_of_its_own_takes_the_place_of_the_embeddings() -> None:
    places = np.array([0.0, 3.0, 1.0, 7.0], np.float32)  # a1, a2, b1, b2
    interleaved = np.abs(np.subtract.outer(places, places))
    scores = score(replace(predict(TRUTH, APART), distances=interleaved), TRUTH)
    # Seen from a1, a2, b1 and b2.
    assert scores.mean_average_precision == pytest.approx(np.mean([1 / 2, 1 / 2, 1 / 3, 1 / 2]))
    assert scores.accuracy == 1.0


@pytest.mark.parametrize("field", ["scores", "embeddings", "distances"])
def test_arrays_that_do_not_fit_the_shapes_are_refused(field: str) -> None:
    with pytest.raises(ValueError, match=field):
        replace(predict(TRUTH, APART), **{field: np.zeros((3, 2), np.float32)})


def test_a_missing_shape_counts_as_misclassified_and_is_named() -> None:
    seen = {shape_id: label for shape_id, label in TRUTH.items() if shape_id != "b2"}
    scores = score(predict(seen, APART), TRUTH)
    assert scores.accuracy == 0.75
    assert (scores.tested, scores.missing) == (4, ["b2"])
    assert scores.mean_average_precision == 1.0


def test_a_class_that_nothing_trained_is_never_right() -> None:
    prediction = predict({"a1": "a", "a2": "a", "b1": "a", "b2": "a"}, APART)
    assert prediction.classes == ("a",)
    assert score(prediction, TRUTH).accuracy == 0.5
