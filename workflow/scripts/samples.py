"""What a classifier reads and writes: features of a whole database, a split, a prediction."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from gipkg.files import read_csv, write_arrays
from gipkg.learning.prediction import Prediction
from gipkg.shards import Shard
from numpy.typing import NDArray


class Features(Mapping[str, NDArray[Any]]):
    """One named array of every shape of a database, read from its shard when asked for."""

    def __init__(self, paths: Collection[str], name: str) -> None:
        shards = [Shard.open(Path(path)) for path in paths]
        self._shard = {shape_id: shard for shard in shards for shape_id in shard}
        self._name = name

    def __getitem__(self, shape_id: str) -> NDArray[Any]:
        return self._shard[shape_id][shape_id][self._name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._shard)

    def __len__(self) -> int:
        return len(self._shard)


def read_split(path: str, part: str) -> dict[str, str]:
    """Read one part of a split, ``train`` or ``test``: shape id to class, in order."""
    return {row["id"]: row["label"] for row in read_csv(Path(path)) if row["part"] == part}


def write_prediction(path: str, prediction: Prediction) -> None:
    """Write the class scores and signatures of the test shapes."""
    fields = Prediction.__slots__
    write_arrays(Path(path), {field: np.asarray(getattr(prediction, field)) for field in fields})


def read_prediction(path: str) -> Prediction:
    """Read what :func:`write_prediction` wrote."""
    with np.load(path, allow_pickle=False) as arrays:
        return Prediction(
            tuple(arrays["ids"].tolist()),
            tuple(arrays["classes"].tolist()),
            arrays["scores"],
            arrays["embeddings"],
        )
