from __future__ import annotations

import numpy as np
import pytest

from gipkg.evaluation.classification import accuracy


def test_counts_the_shapes_whose_own_class_scores_highest() -> None:
    scores = [[0.9, 0.1, 0.0], [0.2, 0.3, 0.5], [0.3, 0.4, 0.3], [0.0, 0.0, 1.0]]
    assert accuracy(scores, [0, 2, 0, 2]) == 0.75


def test_of_equal_scores_the_first_class_is_predicted() -> None:
    assert accuracy([[0.5, 0.5], [0.5, 0.5]], [0, 1]) == 0.5


@pytest.mark.parametrize(
    ("scores", "labels"), [(np.zeros((0, 3)), []), (np.zeros((2, 3)), [0]), (np.zeros(2), [0, 1])]
)
def test_arguments_that_do_not_fit_are_refused(scores: np.ndarray, labels: list[int]) -> None:
    with pytest.raises(ValueError, match="scores must be"):
        accuracy(scores, labels)
