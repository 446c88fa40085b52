"""What takes part and its splits: by identifiers, classes and seed; the official one as listed."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gipkg.api import Protocol, Shape
from gipkg.datasets import choose, random_split, split
from gipkg.errors import SplitError


@st.composite
def databases(draw: st.DrawFn) -> tuple[list[Shape], int]:
    train_per_class = draw(st.integers(1, 4))
    sizes = draw(st.lists(st.integers(train_per_class + 1, 9), min_size=1, max_size=5))
    shapes = [Shape(f"s{c}-{i}", f"class {c}") for c, n in enumerate(sizes) for i in range(n)]
    return draw(st.permutations(shapes)), train_per_class


@given(databases(), st.integers(0, 2**32), st.randoms(use_true_random=False))
def test_is_a_stratified_partition_whatever_the_order(database, seed, random):
    shapes, train_per_class = database
    train, test = random_split(shapes, train_per_class, seed)
    assert sorted(train + test) == sorted(shape.id for shape in shapes)
    assert list(train) == sorted(train)
    assert list(test) == sorted(test)
    label = {shape.id: shape.label for shape in shapes}
    for name in set(label.values()):
        assert sum(label[i] == name for i in train) == train_per_class

    shuffled = list(shapes)
    random.shuffle(shuffled)
    assert random_split(shuffled, train_per_class, seed) == (train, test)


def test_a_class_keeps_its_split_when_another_is_added():
    first = [Shape(f"a{i}", "a") for i in range(20)]
    second = [Shape(f"b{i}", "b") for i in range(20)]
    alone, _ = random_split(first, 10, seed=3)
    together, _ = random_split(first + second, 10, seed=3)
    assert set(alone) == {i for i in together if i.startswith("a")}
    assert {i[1:] for i in together if i.startswith("b")} != {i[1:] for i in alone}


def test_seeds_give_different_splits_that_use_every_shape():
    shapes = [Shape(f"{c}{i}", c) for c in "ab" for i in range(20)]
    trains = [random_split(shapes, 10, seed)[0] for seed in range(20)]
    assert len(set(trains)) == 20
    assert set().union(*trains) == {shape.id for shape in shapes}


def test_too_few_shapes_names_the_class():
    shapes = [Shape(f"a{i}", "a") for i in range(5)] + [Shape(f"b{i}", "b") for i in range(4)]
    with pytest.raises(SplitError, match="'b' has 4 shapes"):
        random_split(shapes, 4, seed=0)


def test_at_least_one_shape_trains():
    with pytest.raises(SplitError, match="train_per_class"):
        random_split([Shape("a", "a"), Shape("b", "a")], 0, seed=0)


def test_the_official_split_is_that_of_the_listing_whatever_the_seed():
    shapes = [Shape(f"{c}{i}", c, "test" if i > 5 else "train") for c in "ba" for i in range(8)]
    parts = {split(shapes, Protocol("official"), seed) for seed in range(3)}
    ((train, test),) = parts
    assert test == ("a6", "a7", "b6", "b7")
    assert sorted(train + test) == sorted(shape.id for shape in shapes)
    assert split(shapes[::-1], Protocol("official"), 0) == (train, test)
    assert split(shapes, Protocol(3), 0) == random_split(shapes, 3, 0)


def test_a_shape_outside_the_official_split_is_named():
    shapes = [Shape("a", "a", "train"), Shape("b", "a", "test"), Shape("c", "a")]
    with pytest.raises(SplitError, match="'c' is in neither part"):
        split(shapes, Protocol("official"), seed=0)
    with pytest.raises(SplitError, match="empty"):
        split(shapes[:1], Protocol("official"), seed=0)


@pytest.mark.parametrize("train_per_class", [3, 0.8, "official"])
def test_something_must_be_left_to_retrieve(train_per_class):
    shapes = [Shape(f"{c}{i}", c, "test" if i == 3 else "train") for c in "ab" for i in range(4)]
    with pytest.raises(SplitError, match="no class has two shapes in the test part"):
        split(shapes, Protocol(train_per_class), seed=0)


@pytest.mark.parametrize("train_per_class", [3, 0.8, "official"])
def test_a_database_without_shapes_cannot_be_split(train_per_class):
    with pytest.raises(SplitError):
        split([], Protocol(train_per_class), seed=0)


@given(databases(), st.randoms(use_true_random=False))
def test_what_takes_part_depends_on_no_order_and_on_no_other_class(database, random):
    shapes, count = database
    kept = sorted({shape.label for shape in shapes})[::2]
    protocol = Protocol(1, classes=kept, shapes_per_class=count)
    chosen = choose(shapes, protocol)
    assert Counter(shape.label for shape in chosen) == dict.fromkeys(kept, count)
    assert [shape for shape in shapes if shape in chosen] == [*chosen]
    assert set(choose(random.sample(shapes, len(shapes)), protocol)) == set(chosen)
    of_all_classes = choose(shapes, replace(protocol, classes=None))
    assert tuple(shape for shape in of_all_classes if shape.label in kept) == chosen
    assert choose(shapes, Protocol(1)) == tuple(shapes)


def test_every_seed_splits_the_same_shapes():
    shapes = [Shape(f"{c}{i}", c) for c in "abc" for i in range(9)]
    protocol = Protocol(3, classes=("c", "a"), shapes_per_class=6)
    chosen = choose(shapes, protocol)
    assert len(chosen) == 12
    splits = [split(shapes, protocol, seed) for seed in range(5)]
    assert len(set(splits)) == 5
    for seed, (train, test) in enumerate(splits):
        assert sorted(train + test) == [shape.id for shape in chosen]
        assert (train, test) == random_split(chosen, 3, seed)
    fewer = split(shapes, replace(protocol, train_per_class=1), 0)
    assert sorted(sum(fewer, ())) == [shape.id for shape in chosen]


@pytest.mark.parametrize(
    ("protocol", "words"),
    [
        (Protocol(1, classes=["ant"]), r"no class 'ant'; did you mean 'ants'\? \(ants, crabs\)"),
        (Protocol(1, shapes_per_class=5), "'ants' has 4 shapes, of which 5 would take part"),
    ],
)
def test_what_cannot_take_part_is_named(protocol, words):
    shapes = [Shape(f"{c}{i}", c) for c in ("ants", "crabs") for i in range(4)]
    with pytest.raises(SplitError, match=words):
        split(shapes, protocol, seed=0)
