"""What a classifier reads and writes: features of a whole database, a split, a prediction."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from gipkg.files import read_csv, write_arrays, write_json
from gipkg.formats.arrays import read_arrays
from gipkg.learning.prediction import Prediction
from gipkg.shards import content_key
from gipkg.zip_damage import naming_damage, require_whole_directory
from numpy.typing import NDArray

from shards import Shards


class Features(Mapping[str, NDArray[Any]]):
    """One named array of every shape of a database, read from its shard when asked for."""

    def __init__(self, paths: Collection[str], name: str) -> None:
        self._shards = Shards(paths)
        self._name = name

    def __getitem__(self, shape_id: str) -> NDArray[Any]:
        return self._shards[shape_id][self._name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._shards)

    def __len__(self) -> int:
        return len(self._shards)

    def __contains__(self, shape_id: object) -> bool:
        return shape_id in self._shards


def read_split(path: str, part: str) -> dict[str, str]:
    """Read one part of a split, ``train`` or ``test``: shape id to class, in order."""
    return {row["id"]: row["label"] for row in read_csv(Path(path)) if row["part"] == part}


def predict_test_part(
    snakemake: Any, features: Features, predict: Callable[..., Prediction]
) -> None:
    """Train on one part of the job's split, predict the other, and write how long it took.

    Parameters
    ----------
    snakemake : object
        The job: a split in, a prediction and its seconds out.
    features : Features
        A shape that has none failed in an earlier stage and is in neither part.
    predict : callable
        Called as ``predict(features, train, test, seed=…, checkpoint=…)``.
    """
    work = Path(snakemake.output.prediction).with_suffix(".work")
    # Named by parameters and code: what other code had half trained is never gone on with.
    checkpoint = work / f"{content_key(dict(snakemake.params.items()))}.pt"
    parts = (read_split(snakemake.input.split, part) for part in ("train", "test"))
    train, test = ({i: part[i] for i in part if i in features} for part in parts)
    # Of a training that goes on from a checkpoint, only the rest is seen.
    seconds: dict[str, float | bool] = {"resumed": checkpoint.exists()}
    wall, cpu = time.perf_counter(), time.process_time()
    prediction = predict(
        features, train, tuple(test), seed=int(snakemake.wildcards.seed), checkpoint=checkpoint
    )
    seconds |= {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}
    write_json(Path(snakemake.output.seconds), seconds, sealed=True)
    write_prediction(snakemake.output.prediction, prediction)
    with suppress(FileNotFoundError):
        shutil.rmtree(work)


def write_prediction(path: str, prediction: Prediction) -> None:
    """Write what is said of the test shapes."""
    fields = {field: getattr(prediction, field) for field in Prediction.__slots__}
    known = {field: np.asarray(value) for field, value in fields.items() if value is not None}
    write_arrays(Path(path), known)


def read_prediction(path: str) -> Prediction:
    """Read what :func:`write_prediction` wrote.

    Raises
    ------
    DamagedFileError
        The file is not a whole prediction.
    """
    with naming_damage(Path(path), "not a whole prediction", "run the command again"):
        # Distances, which not every baseline has, are not to go unnoticed.
        require_whole_directory(Path(path))
        arrays = read_arrays(Path(path))
        return Prediction(
            tuple(arrays["ids"].tolist()),
            tuple(arrays["classes"].tolist()),
            arrays["scores"],
            arrays["embeddings"],
            arrays.get("distances"),
        )
