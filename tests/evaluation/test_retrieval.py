from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from sklearn.metrics import average_precision_score, precision_recall_curve

from gipkg.evaluation.retrieval import RECALL_LEVELS, mean_average_precision, precision_recall

# Distances between shapes, and their classes.
Case = tuple[NDArray[np.float64], NDArray[np.int64]]


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Few shapes at whole-numbered places, so that many distances are equal."""
    n = draw(st.integers(3, 14))
    places = st.lists(st.integers(-2, 2), min_size=2 * n, max_size=2 * n)
    where = np.array(draw(places), dtype=float).reshape(n, 2)
    labels = np.array(draw(st.lists(st.integers(0, 3), min_size=n, max_size=n)))
    labels[1] = labels[0]
    return between(where), labels


def between(places: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.linalg.norm(places[:, None] - places, axis=-1)


def queries(case: Case) -> list[tuple[NDArray[np.bool_], NDArray[np.float64]]]:
    """Relevance and distance of the other shapes, for every query that has something to find."""
    distances, labels = case
    found = []
    for i in range(len(labels)):
        others = np.arange(len(labels)) != i
        relevant = (labels == labels[i])[others]
        if relevant.any():
            found.append((relevant, distances[i, others]))
    return found


@given(cases())
def test_mean_average_precision_equals_that_of_scikit_learn(case: Case) -> None:
    expected = np.mean([average_precision_score(r, -d) for r, d in queries(case)])
    assert mean_average_precision(*case) == pytest.approx(expected, abs=1e-12)


@given(cases())
def test_precision_recall_equals_the_envelope_of_scikit_learns_curve(case: Case) -> None:
    expected = np.zeros(11)
    for relevant, distances in queries(case):
        precision, recall, _ = precision_recall_curve(relevant, -distances)
        precision, recall = precision[:-1], recall[:-1]  # without its artificial end
        expected += [precision[recall >= level - 1e-9].max() for level in RECALL_LEVELS]
    np.testing.assert_allclose(
        precision_recall(*case), expected / len(queries(case)), rtol=0, atol=1e-12
    )


@given(cases(), st.randoms(use_true_random=False))
def test_the_order_of_the_shapes_does_not_matter(case: Case, random: object) -> None:
    distances, labels = case
    order = np.array(random.sample(range(len(labels)), len(labels)))  # type: ignore[attr-defined]
    other = distances[np.ix_(order, order)], labels[order]
    expected = mean_average_precision(*case)
    assert mean_average_precision(*other) == pytest.approx(expected, abs=1e-12)
    np.testing.assert_allclose(precision_recall(*other), precision_recall(*case), atol=1e-12)


def test_average_precision_by_hand() -> None:
    # From 0: relevant at 1 (1 of 1) and at 3 (2 of 3); from 1: at 0 and 2 away, with 1.2 away
    # between (1/1, 2/3); from 3: 0.8 (none), 2 (1 of 2), 3 (2 of 3). The class of 2.2 is alone.
    distances = between(np.array([[0.0], [1.0], [3.0], [2.2]]))
    labels = np.array(["a", "a", "a", "b"])
    expected = np.mean([(1 + 2 / 3) / 2, (1 + 2 / 3) / 2, (1 / 2 + 2 / 3) / 2])
    assert mean_average_precision(distances, labels) == pytest.approx(expected, abs=1e-15)


def test_separated_classes_are_retrieved_perfectly() -> None:
    rng = np.random.default_rng(0)
    labels = np.repeat(np.arange(5), 8)
    distances = between(10.0 * np.eye(5)[labels] + rng.normal(scale=0.1, size=(40, 5)))
    assert mean_average_precision(distances, labels) == 1.0
    np.testing.assert_array_equal(precision_recall(distances, labels), np.ones(11))


def test_equal_distances_retrieve_everything_at_once() -> None:
    labels = np.repeat([0, 1], 5)
    assert mean_average_precision(np.zeros((10, 10)), labels) == pytest.approx(4 / 9)


@pytest.mark.parametrize(
    ("distances", "labels", "fault"),
    [
        (np.zeros((3, 3)), [0, 1, 2], "no class has two"),
        (np.zeros((3, 3)), [0, 0], "must be"),
        (np.array([[0.0, np.nan], [1.0, 0.0]]), [0, 0], "finite"),
    ],
)
def test_what_cannot_be_ranked_is_refused(
    distances: np.ndarray, labels: list[int], fault: str
) -> None:
    with pytest.raises(ValueError, match=fault):
        mean_average_precision(distances, labels)
