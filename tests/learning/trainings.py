"""Short trainings on tiny images, and what is asked of their predictions."""

from __future__ import annotations

from typing import Any

import numpy as np

from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.model import Model, train_model
from gipkg.learning.prediction import Prediction
from tests.learning.synthetic import synthetic_images

IMAGES, LABELS = synthetic_images(18)
IDS = tuple(IMAGES)
TRAIN, TEST = IDS[:9], IDS[9:]
SMALL = NetworkConfig(blocks=((6,), (8,), (10,)), dropout=0.2)
TOGETHER = SMALL.model_copy(update={"together": 2})
SHORT = TrainingConfig(epochs=8, minimum_steps=1, batch_size=12)
LONGER = TrainingConfig(epochs=15, minimum_steps=1, batch_size=12)


def trained(images: Any = IMAGES, **changes: Any) -> Model:
    arguments: dict[str, Any] = {"network": SMALL, "training": SHORT, "device": "cpu", **changes}
    # Neither images nor labels of the test part are there.
    known, shown = ({i: those[i] for i in TRAIN} for those in (LABELS, images))
    return train_model(shown, known, TRAIN, **arguments)


def run(images: Any = IMAGES, **changes: Any) -> Prediction:
    return trained(images, **changes).predict(images, TEST)


def accuracy(found: Prediction) -> float:
    predicted = [found.classes[i] for i in found.scores.argmax(axis=1)]
    return float(np.mean([LABELS[i] == label for i, label in zip(TEST, predicted, strict=True)]))


def assert_equal(first: Prediction, second: Prediction) -> None:
    assert (first.ids, first.classes) == (second.ids, second.classes)
    np.testing.assert_array_equal(first.scores, second.scores)
    np.testing.assert_array_equal(first.embeddings, second.embeddings)
