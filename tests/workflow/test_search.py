"""A mesh is shown to a network that the workflow kept as the workflow showed it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from gipkg.registry import create
from gipkg.search.network import SignatureNetwork
from gipkg.shards import Shard
from tests.workflow.workdir import REPOSITORY, Workdir

DATASETS = yaml.safe_load((REPOSITORY / "config/smoke.yaml").read_text())["datasets"]


@pytest.mark.parametrize("database", DATASETS)
def test_images_and_signatures_are_the_workflows(smoke: Workdir, database: str) -> None:
    results = smoke.path / "results"
    file, *_ = sorted((results / "learning" / database).rglob("*-0.model.npz"))
    network = SignatureNetwork.read(file)
    with np.load(str(file).replace(".model.npz", ".npz"), allow_pickle=False) as prediction:
        shape_id = str(prediction["ids"][0])
        embedding = prediction["embeddings"][0]
    images = network.maker.images(load(database, shape_id), shape_id)
    folder = results / "images" / file.parent.parent.relative_to(results / "learning")
    np.testing.assert_array_equal(images, stored(folder, shape_id))
    said = network.model.predict({shape_id: images}, [shape_id])
    np.testing.assert_array_equal(said.embeddings[0], embedding)


def load(database: str, shape_id: str) -> Any:
    """Return a shape as its database has it."""
    parameters = {
        key: value
        for key, value in DATASETS[database].items()
        if key not in ("plugin", "shards", "protocols", "surface")
    }
    return create("dataset", DATASETS[database]["plugin"], parameters).load(Path(), shape_id)


def stored(folder: Path, shape_id: str) -> np.ndarray:
    """Return the images that the workflow left."""
    shards = [Shard.open(path) for path in folder.glob("*.npz")]
    (shard,) = [shard for shard in shards if shape_id in shard]
    return shard[shape_id]["images"]
