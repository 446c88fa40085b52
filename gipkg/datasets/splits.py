"""What of a database takes part, and its split in two: random ones and the official one."""

from __future__ import annotations

import zlib
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence

import numpy as np

from gipkg.api import Protocol, Shape
from gipkg.errors import SplitError, did_you_mean

Parts = tuple[tuple[str, ...], tuple[str, ...]]


def split(shapes: Sequence[Shape], protocol: Protocol, seed: int) -> Parts:
    """Split what takes part of a database as a protocol says.

    Returns
    -------
    train, test : tuple of str
        Identifiers of the two parts, each sorted.

    Raises
    ------
    SplitError
        As :func:`choose`, :func:`random_split` and :func:`official_split`; or no class has two
        test shapes, so that none can be retrieved by another.
    """
    shapes = choose(shapes, protocol)
    if protocol.train_per_class == "official":
        train, test = official_split(shapes)
    else:
        train, test = random_split(shapes, protocol.train_per_class, seed)
    tested = frozenset(test)
    sizes = Counter(shape.label for shape in shapes if shape.id in tested)
    if max(sizes.values(), default=0) < 2:
        raise SplitError(
            "no class has two shapes in the test part, so nothing can be retrieved; let fewer "
            "train, or use larger classes"
        )
    return train, test


def choose(shapes: Sequence[Shape], protocol: Protocol) -> tuple[Shape, ...]:
    """Return the shapes that take part, in the order given.

    Like a random split, the choice depends on the identifiers and the classes alone, and every
    class draws by itself.

    Raises
    ------
    SplitError
        The database lacks a class of the protocol, or a class has too few shapes.
    """
    members = _by_class(shapes)
    for label in protocol.classes or ():
        if label not in members:
            raise SplitError(
                f"there is no class {label!r}{did_you_mean(label, members)} "
                f"({', '.join(sorted(members))})"
            )
    chosen: set[str] = set()
    for label in protocol.classes or members:
        ids, count = members[label], protocol.shapes_per_class
        if count is not None and len(ids) < count:
            raise SplitError(
                f"class {label!r} has {len(ids)} shapes, of which {count} would take part; change "
                "shapes_per_class, or leave the class out"
            )
        chosen.update(_shuffled(label, ids, seed=0)[:count])
    return tuple(shape for shape in shapes if shape.id in chosen)


def official_split(shapes: Sequence[Shape]) -> Parts:
    """Split a database into the parts that it is published with.

    Returns
    -------
    train, test : tuple of str
        Identifiers of the two parts, each sorted.

    Raises
    ------
    SplitError
        A shape is in neither part, or a part is empty.
    """
    astray = min((shape.id for shape in shapes if shape.part is None), default=None)
    if astray is not None:
        raise SplitError(
            f"shape {astray!r} is in neither part: the database has no official split; give a "
            "number or a share of training shapes instead"
        )
    train, test = (
        tuple(sorted(shape.id for shape in shapes if shape.part == part))
        for part in ("train", "test")
    )
    if not (train and test):
        raise SplitError("one part of the official split is empty; both must have shapes")
    return train, test


def random_split(shapes: Sequence[Shape], train_per_class: int | float, seed: int) -> Parts:
    """Split every class at random into `train_per_class` training shapes and the others.

    The split depends on the identifiers, the classes and the seed alone, not on the order
    of `shapes`. Every class draws from a generator of its own, so that adding a class to a
    database leaves the split of the others as it was.

    Parameters
    ----------
    shapes : sequence of Shape
        The database; identifiers are unique.
    train_per_class : int or float
        Number of training shapes in each class, at least 1; or, between 0 and 1, their share
        of the class, rounded down.
    seed : int
        Non-negative; another seed gives another split.

    Returns
    -------
    train, test : tuple of str
        Identifiers of the two parts, each sorted.

    Raises
    ------
    SplitError
        A class would have no training or no test shape, or `train_per_class` is neither a
        number of shapes nor a share.
    """
    train: list[str] = []
    test: list[str] = []
    for label, ids in _by_class(shapes).items():
        count = training_count(train_per_class, len(ids))
        if not 0 < count < len(ids):
            raise SplitError(
                f"class {label!r} has {len(ids)} shapes, of which {count} would train: at least "
                "one must train and one test; change train_per_class, or use larger classes"
            )
        shuffled = _shuffled(label, ids, seed)
        train += shuffled[:count]
        test += shuffled[count:]
    return tuple(sorted(train)), tuple(sorted(test))


def training_count(train_per_class: int | float, size: int) -> int:
    """Return how many of a class of `size` shapes train.

    Raises
    ------
    SplitError
        `train_per_class` is neither a number of shapes nor a share.
    """
    if 0 < train_per_class < 1:
        return int(train_per_class * size)
    if train_per_class >= 1 and train_per_class == int(train_per_class):
        return int(train_per_class)
    raise SplitError(
        f"train_per_class is {train_per_class}: at least one shape must train; give a number of "
        "shapes, or a share between 0 and 1"
    )


def _by_class(shapes: Iterable[Shape]) -> dict[str, list[str]]:
    members: dict[str, list[str]] = defaultdict(list)
    for shape in shapes:
        members[shape.label].append(shape.id)
    return members


def _shuffled(label: str, ids: Iterable[str], seed: int) -> list[str]:
    rng = np.random.default_rng([seed, zlib.crc32(label.encode())])
    shuffled: list[str] = rng.permutation(sorted(ids)).tolist()
    return shuffled
