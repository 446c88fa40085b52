"""What the scripts of the classifiers hand on."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from gipkg.errors import DamagedFileError
from gipkg.files import read_json, write_csv
from gipkg.learning.prediction import Prediction
from gipkg.shards import map_shard
from tests.workflow.workdir import REPOSITORY

PLAIN = Prediction(
    ("s3", "s4"), ("a", "b", "c"), np.eye(2, 3, dtype=np.float32), np.ones((2, 5), np.float32)
)
WITH_DISTANCES = Prediction(
    PLAIN.ids, PLAIN.classes, PLAIN.scores, PLAIN.embeddings, np.eye(2, dtype=np.float32)
)


@pytest.fixture
def samples(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(REPOSITORY / "workflow" / "scripts")
    return importlib.import_module("samples")


def require_equal(one: Prediction, other: Prediction) -> None:
    assert (one.ids, one.classes) == (other.ids, other.classes)
    for name in ("scores", "embeddings", "distances"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


@pytest.mark.parametrize("prediction", [PLAIN, WITH_DISTANCES], ids=["plain", "distances"])
def test_a_prediction_comes_back_as_it_was(
    samples: ModuleType, tmp_path: Path, prediction: Prediction
) -> None:
    samples.write_prediction(str(tmp_path / "one.npz"), prediction)
    require_equal(samples.read_prediction(str(tmp_path / "one.npz")), prediction)


def test_a_damaged_prediction_is_named(samples: ModuleType, tmp_path: Path) -> None:
    path = tmp_path / "one.npz"
    samples.write_prediction(str(path), WITH_DISTANCES)
    content = bytearray(path.read_bytes())
    content[content.rindex(b"distances.npy")] ^= 1
    path.write_bytes(content)
    with pytest.raises(DamagedFileError, match=r"one\.npz: not a whole prediction"):
        samples.read_prediction(str(path))


def test_shapes_without_features_are_in_neither_part_and_the_time_is_kept_apart(
    samples: ModuleType, tmp_path: Path
) -> None:
    shard, split = tmp_path / "0.npz", tmp_path / "split.csv"
    known = {f"s{n}": {"vector": np.full(2, float(n))} for n in (0, 1, 3, 4)}
    map_shard(tuple(known), known.__getitem__, shard, tmp_path / "work", "test", key="k")
    parts = ["train", "train", "train", "test", "test", "test"]
    rows = [(f"s{n}", "ab"[n % 2], part) for n, part in enumerate(parts)]
    write_csv(split, ("id", "label", "part"), rows)

    def predict(features, train, test, *, seed, checkpoint) -> Prediction:
        assert train == {"s0": "a", "s1": "b"}
        assert test == ("s3", "s4")
        assert seed == 7
        np.testing.assert_array_equal(features["s1"], [1, 1])
        asked.append(checkpoint)
        checkpoint.parent.mkdir(exist_ok=True)
        checkpoint.write_text("half done")
        return PLAIN

    job = SimpleNamespace(
        input=SimpleNamespace(split=str(split)),
        output=SimpleNamespace(
            prediction=str(tmp_path / "p.npz"), seconds=str(tmp_path / "p.json")
        ),
        wildcards=SimpleNamespace(seed="7"),
        params={"code": "of today"},
    )
    asked: list[Path] = []
    for resumed in (False, True):
        samples.predict_test_part(job, samples.Features([str(shard)], "vector"), predict)
        seconds = read_json(tmp_path / "p.json", sealed=True)
        assert seconds.pop("resumed") is resumed
        assert set(seconds) == {"wall", "cpu"}
        assert min(seconds.values()) > 0
        require_equal(samples.read_prediction(str(tmp_path / "p.npz")), PLAIN)
        assert not asked[-1].parent.exists()
        asked[-1].parent.mkdir()
        asked[-1].write_text("left by a killed run")
    assert asked[0] == asked[1]
    # What other code has left is not for this one.
    job.params["code"] = "of tomorrow"
    samples.predict_test_part(job, samples.Features([str(shard)], "vector"), predict)
    assert asked[2] != asked[1]
    assert not read_json(tmp_path / "p.json", sealed=True)["resumed"]
