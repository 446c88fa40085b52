"""Predictions that many tests compare theirs with."""

from __future__ import annotations

import pytest

from gipkg.learning.prediction import Prediction
from tests.learning.trainings import TOGETHER, run


@pytest.fixture(scope="session")
def undisturbed() -> Prediction:
    return run()


@pytest.fixture(scope="session")
def undisturbed_together() -> Prediction:
    return run(network=TOGETHER)
