"""A few shapes that stand for a database."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import numpy as np

from gipkg.api import Shape


def spread_over_classes(shapes: Iterable[Shape], count: int) -> tuple[str, ...]:
    """Choose shapes of as many classes as there are, in the order of the classes' names.

    Where there are more classes than shapes wanted, the classes are taken at even distances;
    where there are fewer, they take turns. Of a class the first identifiers are chosen.

    Parameters
    ----------
    shapes : iterable of Shape
    count : int
        How many are wanted, at least 1; no more are returned than there are.

    Returns
    -------
    tuple of str
        Identifiers.
    """
    turns = []
    seen: Counter[str] = Counter()
    for shape in sorted(shapes, key=lambda shape: shape.id):
        turns.append((seen[shape.label], shape.label, shape.id))
        seen[shape.label] += 1
    turns.sort()
    if count < len(seen):
        positions = np.linspace(0, len(seen) - 1, count).round().astype(int)
        turns = [turns[position] for position in positions]
    return tuple(shape_id for _, _, shape_id in turns[:count])
