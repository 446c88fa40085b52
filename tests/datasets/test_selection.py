from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from gipkg.api import Shape
from gipkg.datasets.selection import spread_over_classes

SHAPES = [Shape(f"{label}{number}", label) for number in range(3) for label in "dcba"]


def test_classes_take_turns() -> None:
    assert spread_over_classes(SHAPES, 4) == ("a0", "b0", "c0", "d0")
    assert spread_over_classes(SHAPES, 6) == ("a0", "b0", "c0", "d0", "a1", "b1")
    assert len(spread_over_classes(SHAPES, 100)) == len(SHAPES)


def test_few_shapes_come_from_classes_far_apart() -> None:
    assert spread_over_classes(SHAPES, 2) == ("a0", "d0")
    assert spread_over_classes(SHAPES, 3) == ("a0", "c0", "d0")
    assert spread_over_classes(SHAPES, 1) == ("a0",)


@given(
    labels=st.lists(st.sampled_from("abcdefg"), min_size=1, max_size=30),
    count=st.integers(1, 40),
    order=st.randoms(use_true_random=False),
)
def test_the_choice_is_unique_full_and_of_as_many_classes_as_can_be(
    labels: list[str], count: int, order: object
) -> None:
    shapes = [Shape(f"{number:02d}", label) for number, label in enumerate(labels)]
    chosen = spread_over_classes(shapes, count)
    assert len(set(chosen)) == len(chosen) == min(count, len(shapes))
    classes = {labels[int(shape_id)] for shape_id in chosen}
    assert len(classes) == min(count, len(set(labels)))
    shuffled = list(shapes)
    order.shuffle(shuffled)
    assert spread_over_classes(shuffled, count) == chosen
