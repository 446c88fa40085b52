"""ModelNet10's grids: the official split, the empty ones by name, and which way is up."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from gipkg.api import Protocol
from gipkg.datasets import modelnet_voxels, split
from gipkg.datasets.modelnet_voxels import ARCHIVE, EMPTY, ModelNet10Voxels
from gipkg.errors import DamagedFileError, DatasetNotFound


@pytest.fixture(scope="module")
def root(data_root: Path) -> Path:
    if not ModelNet10Voxels().available(data_root):
        pytest.skip(f"no {ARCHIVE} under {data_root}")
    return data_root


@pytest.fixture(scope="module")
def shapes(root):
    return ModelNet10Voxels().shapes(root)


def test_the_official_split_without_the_empty_grids(shapes):
    train, test = split(shapes, Protocol("official"), seed=0)
    assert (len(train), len(test)) == (3991 - 7, 908 - 1)
    sizes = Counter(shape.label for shape in shapes if shape.part == "test")
    assert sizes.pop("bathtub") == 50
    assert sizes.pop("desk") == 85
    assert sizes.pop("dresser") == sizes.pop("night_stand") == 86
    assert set(sizes.values()) == {100}


def test_the_grids_left_out_are_the_empty_ones(root):
    found = set()
    for part in ("train", "test"):
        packed = modelnet_voxels._packed_grids(root / ARCHIVE, f"X_{part}.npy")
        found |= {f"{part}-{number:04d}" for number in np.flatnonzero(~packed.any(axis=1))}
    assert {name.partition("-")[2] for name in EMPTY} == found
    assert set(ModelNet10Voxels.tags.excluded) == set(EMPTY)
    with pytest.raises(DatasetNotFound, match="'desk-test-0304'"):
        ModelNet10Voxels().load(root, "desk-test-0304")


def test_a_grid_is_the_one_in_the_file(root, shapes):
    with np.load(root / ARCHIVE, allow_pickle=False) as arrays:
        grids, labels = arrays["X_test"], arrays["y_test"]
    for shape in [shape for shape in shapes if shape.part == "test"][::90]:
        number = int(shape.id[-4:])
        volume = ModelNet10Voxels().load(root, shape.id)
        np.testing.assert_array_equal(volume.values, grids[number])
        assert modelnet_voxels.LABELS[labels[number]] == shape.label


def test_tables_carry_their_weight_high_along_the_last_axis(root, shapes):
    offsets = []
    for shape in shapes:
        if shape.label == "table" and shape.part == "test":
            voxels = np.argwhere(ModelNet10Voxels().load(root, shape.id).values)
            low, high = voxels.min(axis=0), voxels.max(axis=0)
            offsets.append((voxels.mean(axis=0) - (low + high) / 2) / (high - low + 1))
    x, y, z = np.mean(offsets, axis=0)
    assert max(abs(x), abs(y)) < 0.02
    assert z > 0.1


def test_without_the_file_it_says_where_it_belongs(tmp_path):
    dataset = ModelNet10Voxels()
    for action in (dataset.fetch, dataset.shapes, lambda root: dataset.load(root, "a")):
        with pytest.raises(DatasetNotFound, match="modelnet10"):
            action(tmp_path)
    (tmp_path / ARCHIVE).parent.mkdir()
    (tmp_path / ARCHIVE).write_bytes(b"PK")
    with pytest.raises(DamagedFileError, match="SHA-256"):
        dataset.shapes(tmp_path)
