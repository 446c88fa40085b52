from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gipkg.baselines.svm import classify


def clouds(
    classes: int, count: int, spread: float = 0.3
) -> tuple[dict[str, NDArray[np.float64]], dict[str, str]]:
    """`count` vectors around each of some corners of a simplex, in features of any scale."""
    rng = np.random.default_rng(0)
    units = np.array([1e-6, 1.0, 1e6, 1.0, 1e3])
    vectors, labels = {}, {}
    for i in range(classes * count):
        label = i % classes
        vectors[f"s{i}"] = (np.eye(5)[label] + rng.normal(scale=spread, size=5)) * units
        labels[f"s{i}"] = f"class {label}"
    return vectors, labels


def first(count: int, labels: dict[str, str]) -> dict[str, str]:
    """The training part: the labels of the others are not even there."""
    return dict(list(labels.items())[:count])


@pytest.mark.parametrize("classes", [2, 4])
def test_classes_are_told_apart_whatever_the_units(classes: int) -> None:
    vectors, labels = clouds(classes, 20, spread=0.1)
    ids = tuple(vectors)
    found = classify(vectors, first(10 * classes, labels), ids[10 * classes :])
    assert found.ids == ids[10 * classes :]
    assert found.classes == tuple(sorted(set(labels.values())))
    assert found.scores.shape == (10 * classes, classes)
    predicted = [found.classes[i] for i in found.scores.argmax(axis=1)]
    assert predicted == [labels[i] for i in found.ids]


def test_embeddings_are_the_representations() -> None:
    vectors, labels = clouds(3, 6)
    ids = tuple(vectors)
    found = classify(vectors, first(9, labels), ids[9:])
    np.testing.assert_array_equal(
        found.embeddings, np.stack([vectors[i] for i in ids[9:]]).astype(np.float32)
    )


def test_the_test_part_chooses_nothing() -> None:
    vectors, labels = clouds(3, 12)
    ids = tuple(vectors)
    train, test = first(18, labels), ids[18:]
    before = classify(vectors, train, test)
    changed = {**vectors, test[-1]: vectors[test[-1]] * 1e4}
    after = classify(changed, train, test)
    np.testing.assert_array_equal(after.scores[:-1], before.scores[:-1])
    assert (after.scores[-1] != before.scores[-1]).any()


def test_one_shape_a_class_is_enough_to_train() -> None:
    vectors, labels = clouds(4, 5, spread=0.05)
    ids = tuple(vectors)
    found = classify(vectors, first(4, labels), ids[4:])
    assert (found.scores.argmax(axis=1) == np.arange(16) % 4).all()


def test_the_seed_fixes_the_result() -> None:
    vectors, labels = clouds(3, 12, spread=0.6)
    ids = tuple(vectors)
    train = first(18, labels)
    one, other = (classify(vectors, train, ids[18:], seed=4) for _ in range(2))
    np.testing.assert_array_equal(one.scores, other.scores)
