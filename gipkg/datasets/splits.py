"""Random splits of a database into a training and a test part."""

from __future__ import annotations

import zlib
from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from gipkg.api import Shape
from gipkg.errors import SplitError


def random_split(
    shapes: Sequence[Shape], train_per_class: int, seed: int
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Split every class at random into `train_per_class` training shapes and the others.

    The split depends on the identifiers, the classes and the seed alone, not on the order
    of `shapes`. Every class draws from a generator of its own, so that adding a class to a
    database leaves the split of the others as it was.

    Parameters
    ----------
    shapes : sequence of Shape
        The database; identifiers are unique.
    train_per_class : int
        Number of training shapes in each class, at least 1.
    seed : int
        Non-negative; another seed gives another split.

    Returns
    -------
    train, test : tuple of str
        Identifiers of the two parts, each sorted.

    Raises
    ------
    SplitError
        A class would have no test shape, or `train_per_class` is below 1.
    """
    if train_per_class < 1:
        raise SplitError(f"train_per_class is {train_per_class}: at least one shape must train")
    members: dict[str, list[str]] = defaultdict(list)
    for shape in shapes:
        members[shape.label].append(shape.id)

    train: list[str] = []
    test: list[str] = []
    for label, ids in members.items():
        if len(ids) <= train_per_class:
            raise SplitError(
                f"class {label!r} has {len(ids)} shapes: too few for {train_per_class} to train "
                f"and at least one to test; use fewer training shapes or more shapes a class"
            )
        rng = np.random.default_rng([seed, zlib.crc32(label.encode())])
        shuffled = rng.permutation(sorted(ids)).tolist()
        train += shuffled[:train_per_class]
        test += shuffled[train_per_class:]
    return tuple(sorted(train)), tuple(sorted(test))
