"""All shards of a database, as the scripts read them."""

from __future__ import annotations

import importlib
from pathlib import Path

import numpy as np
import pytest

from gipkg.errors import GipkgError
from gipkg.shards import map_shard
from tests.workflow.workdir import REPOSITORY


def test_shapes_and_failures_of_all_shards_are_together(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def arrays(shape_id: str) -> dict[str, np.ndarray]:
        if shape_id == "bad":
            raise GipkgError("no surface")
        return {"name": np.array(shape_id)}

    paths = []
    for number, ids in enumerate((("d", "a"), ("c", "bad"))):
        paths.append(tmp_path / f"{number}.npz")
        map_shard(ids, arrays, paths[-1], tmp_path / "work", "test", key="k")
    monkeypatch.syspath_prepend(REPOSITORY / "workflow" / "scripts")
    shards = importlib.import_module("shards").Shards(map(str, paths))
    assert {shape_id: str(found["name"]) for shape_id, found in shards.items()} == {
        name: name for name in "adc"
    }
    assert set(shards.failures) == {"bad"}
    # Whether a shape is there is known without its arrays.
    for path in paths:
        path.unlink()
    assert "a" in shards
    assert "bad" not in shards
    assert len(shards) == 3
