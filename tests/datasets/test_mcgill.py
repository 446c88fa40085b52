"""McGill: the real archive whole, and what happens without it."""

from __future__ import annotations

import gzip
import hashlib
import struct
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from gipkg.datasets import choose, mcgill, split
from gipkg.datasets.mcgill import ARCHIVE, ARTICULATED, DUPLICATES, MIXED, McGill
from gipkg.errors import DatasetNotFound, MeshFormatError
from tests.datasets.tar_files import write_archive


@pytest.fixture(scope="module")
def root(data_root: Path) -> Path:
    if not McGill().available(data_root):
        pytest.skip(f"no {ARCHIVE} under {data_root}")
    return data_root


def volume_file(kind: int, shape: tuple[int, int, int], voxels: bytes) -> bytes:
    header = struct.pack("<4sBx3h", b"\1\0\1\0", kind, *shape)
    return gzip.compress(header.ljust(1024, b"\0") + voxels)


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Data root whose archive holds volumes of our own, sound and unsound."""
    bits, floats = np.array([0, 1, 0, 0, 0, 1], np.uint8), np.array([0, 1, 0, 0, 0, 1], "<f4")
    members = {
        "articulated/ants/bits.im.gz": volume_file(1, (2, 3, 1), bits.tobytes()),
        "articulated/ants/floats.im.gz": volume_file(4, (2, 3, 1), floats.tobytes()),
        "articulated/ants/short.im.gz": volume_file(1, (2, 3, 1), bits.tobytes()[:-1]),
        "articulated/ants/unknown.im.gz": volume_file(9, (2, 3, 1), bits.tobytes()),
        "articulated/ants/empty.im.gz": gzip.compress(b""),
        "articulated/ants/text.im.gz": b"no gzip",
    }
    path = tmp_path / ARCHIVE
    path.parent.mkdir()
    monkeypatch.setattr(mcgill, "SHA256", write_archive(path, members))
    return tmp_path


@pytest.mark.parametrize(
    ("name", "classes", "sizes"),
    [
        ("McGill1", MIXED, (100, 100)),
        ("McGill2", MIXED, (160, 40)),
        ("McGillArticulated1", ARTICULATED, (100, 100)),
        ("McGillArticulated2", ARTICULATED, (160, 40)),
    ],
)
def test_twenty_of_each_of_ten_classes(root, name, classes, sizes):
    shapes, protocol = McGill().shapes(root), McGill.protocols[name]
    chosen = choose(shapes, protocol)
    assert Counter(shape.label for shape in chosen) == dict.fromkeys(classes, 20)
    train, test = split(shapes, protocol, seed=0)
    assert (len(train), len(test)) == sizes


def test_all_distinct_shapes_of_all_classes(root):
    shapes = McGill().shapes(root)
    assert len(shapes) == McGill.tags.shapes == 452
    sizes = Counter(shape.label for shape in shapes)
    assert (len(sizes), min(sizes.values()), max(sizes.values())) == (19, 11, 31)
    assert {shape.label for shape in shapes} >= {*MIXED, *ARTICULATED}
    train, test = split(shapes, McGill.protocols["McGill19"], seed=0)
    labels = {shape.id: shape.label for shape in shapes}
    assert Counter(labels[i] for i in train) == {name: size // 2 for name, size in sizes.items()}
    assert len(train) + len(test) == 452


def test_published_splits_stay_what_they_are(root):
    """As of the first figures of these rows: what takes part and what trains, of five seeds."""
    shapes = McGill().shapes(root)
    digests = {
        name: hashlib.sha256(
            repr([split(shapes, protocol, seed) for seed in range(5)]).encode()
        ).hexdigest()[:16]
        for name, protocol in McGill.protocols.items()
    }
    assert digests == {
        "McGill1": "3bb09c1226f79f5a",
        "McGill2": "8909bc19c9ebe477",
        "McGillArticulated1": "68cf905fdb429668",
        "McGillArticulated2": "45804ca3fea7ada1",
        "McGill19": "7a45848c842cbf7f",
    }


def test_what_is_left_out_is_there_under_another_name(root, monkeypatch):
    monkeypatch.setattr(mcgill, "DUPLICATES", {})
    dataset = McGill()
    classes = {shape_id.partition("-")[0] for shape_id in DUPLICATES}
    found = {
        shape.id: hashlib.sha256(dataset.load(root, shape.id).values.tobytes()).digest()
        for shape in dataset.shapes(root)
        if shape.label in classes
    }
    kept = {shape_id: digest for shape_id, digest in found.items() if shape_id not in DUPLICATES}
    assert len(found) == len(kept) + 5
    assert len(set(kept.values())) == len(kept)
    assert all(found[one] == kept[other] for one, other in DUPLICATES.items())


@pytest.mark.parametrize("shape_id", ["ants-1", "hands-b13", "tables-14"])
def test_volumes_are_binary_and_clear_of_the_border(root, shape_id):
    values = McGill().load(root, shape_id).values
    assert values.shape == (128, 128, 128)
    assert set(np.unique(values)) == {0, 1}
    assert not any(
        face.any() for axis in range(3) for face in np.moveaxis(values, axis, 0)[[0, -1]]
    )


@pytest.mark.parametrize("shape_id", ["birds-b18", "ants-b99"])
def test_duplicates_and_unknown_shapes_are_not_there(root, shape_id):
    with pytest.raises(DatasetNotFound, match=f"no shape '{shape_id}'"):
        McGill().load(root, shape_id)


@pytest.mark.parametrize("kind", ["bits", "floats"])
def test_both_types_of_voxels_are_read_with_x_fastest(written, kind):
    values = McGill().load(written, f"ants-{kind}").values
    assert np.argwhere(values).tolist() == [[1, 0, 0], [1, 2, 0]]
    assert values.shape == (2, 3, 1)


@pytest.mark.parametrize("fault", ["short", "unknown", "empty", "text"])
def test_unreadable_member_is_named(written, fault):
    with pytest.raises(MeshFormatError, match=rf"articulated/ants/{fault}\.im\.gz"):
        McGill().load(written, f"ants-{fault}")


def test_fetch_names_the_addresses_and_the_folder(tmp_path):
    with pytest.raises(DatasetNotFound) as caught:
        McGill().fetch(tmp_path)
    for clue in (mcgill.HOME, mcgill.COPY, mcgill.SHA256, str(tmp_path / "mcgill")):
        assert clue in str(caught.value)


def test_nothing_is_fetched_when_it_is_there(root):
    McGill().fetch(root)
