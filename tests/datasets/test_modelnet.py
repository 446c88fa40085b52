"""ModelNet's meshes from the archive and from the folder: small ones of the same layout."""

from __future__ import annotations

import os
import tarfile
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import ClassVar
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import numpy as np
import pytest

from gipkg.api import DatasetTags
from gipkg.datasets import modelnet, official_split, zip_archives
from gipkg.datasets.modelnet import ModelNet10, ModelNetMeshes
from gipkg.errors import DamagedFileError, DatasetNotFound, MeshFormatError
from tests.datasets.tar_files import checksum
from tests.support.zip_bits import with_a_changed_bit

TRIANGLE = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
GLUED = b"OFF4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
"""The header runs into the counts, as in many files of ModelNet40."""
MODELS = {
    "ModelNet10/night_stand/train/night_stand_0001.off": TRIANGLE,
    "ModelNet10/night_stand/train/night_stand_0002.off": GLUED,
    "ModelNet10/night_stand/test/night_stand_0003.off": TRIANGLE,
    "ModelNet10/bed/train/bed_0001.off": b"OFF\n1 1 0\n0 0 0\n3 0 0 9\n",
    "ModelNet10/bed/test/bed_0002.off": TRIANGLE,
}
STRANGE = {
    "ModelNet10/README.txt": b"",
    "ModelNet10/bed/train/.DS_Store": b"",
    "__MACOSX/ModelNet10/bed/train/._bed_0001.off": TRIANGLE,
    "../../ModelNet10/bed/train/bed_0009.off": TRIANGLE,
    "/ModelNet10/bed/train/bed_0009.off": TRIANGLE,
    "ModelNet10/../train/bed_0009.off": TRIANGLE,
    "ModelNet10/bed/train/chair_0009.off": TRIANGLE,
    "ModelNet10/bed/train/bed_0009.off/bed_0009.off": TRIANGLE,
}


class Small(ModelNetMeshes):
    summary: ClassVar[str] = "five models"
    archive: ClassVar[str] = "modelnet10/ModelNet10.zip"
    sources: ClassVar[tuple[str, ...]] = ()
    sizes: ClassVar = {"train": 3, "test": 2}
    tags: ClassVar[DatasetTags]
    protocols: ClassVar = ModelNet10.protocols


@pytest.fixture
def zipped(tmp_path, monkeypatch):
    """Data root with an archive of five models and of what else may be in one."""
    path = tmp_path / Small.archive
    path.parent.mkdir()
    with ZipFile(path, "w") as archive:
        for name, content in (MODELS | STRANGE).items():
            archive.writestr(ZipInfo(name), content)
    declare(path, monkeypatch)
    return tmp_path


@pytest.fixture
def unpacked(tmp_path, monkeypatch):
    """Data root with the folder instead."""
    root = tmp_path / "folders"
    for name, content in MODELS.items():
        path = root / "modelnet10" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    monkeypatch.setattr(Small, "tags", ModelNet10.tags, raising=False)
    return root


def declare(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tags = replace(ModelNet10.tags, shapes=5, classes=2, files={Small.archive: checksum(path)})
    monkeypatch.setattr(Small, "tags", tags, raising=False)


@pytest.mark.parametrize("form", ["zipped", "unpacked"])
def test_archive_and_folder_are_one_database(form, request):
    root = request.getfixturevalue(form)
    assert Small().available(root)
    shapes = Small().shapes(root)
    assert {(shape.id, shape.label, shape.part) for shape in shapes} == {
        ("night_stand_0001", "night_stand", "train"),
        ("night_stand_0002", "night_stand", "train"),
        ("night_stand_0003", "night_stand", "test"),
        ("bed_0001", "bed", "train"),
        ("bed_0002", "bed", "test"),
    }
    assert [shape.id for shape in shapes] == sorted(shape.id for shape in shapes)
    assert official_split(shapes)[1] == ("bed_0002", "night_stand_0003")
    mesh = Small().load(root, "night_stand_0002")
    np.testing.assert_array_equal(mesh.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert len(mesh.faces) == 2
    with pytest.raises(MeshFormatError, match=r"ModelNet10/bed/train/bed_0001\.off: .*not exist"):
        Small().load(root, "bed_0001")


@pytest.mark.parametrize("form", ["zipped", "unpacked"])
@pytest.mark.parametrize("name", ["bed_0009", "bed", "", "../bed/train/bed_0001", "/bed_0001"])
def test_nothing_is_read_from_elsewhere(form, name, request):
    with pytest.raises(DatasetNotFound, match="ModelNet10 has no shape"):
        Small().load(request.getfixturevalue(form), name)


def test_a_member_that_unpacks_to_too_much_is_refused(zipped, monkeypatch):
    monkeypatch.setattr(zip_archives, "MEMBER_LIMIT", len(TRIANGLE) - 1)
    with pytest.raises(DamagedFileError, match=r"\.zip: .*_0001\.off .*bytes; at most"):
        Small().load(zipped, "night_stand_0001")


def test_a_damaged_member_is_named(zipped):
    path = zipped / Small.archive
    content = bytearray(path.read_bytes())
    content[content.index(TRIANGLE) + 15] ^= 1
    path.write_bytes(content)
    with pytest.raises(DamagedFileError, match=r"\.zip: .*night_stand_0001\.off .*CRC.*delete it"):
        Small().load(zipped, "night_stand_0001")
    with pytest.raises(DamagedFileError, match="fetch the database again"):
        Small().shapes(zipped)


def test_a_truncated_archive_is_named(zipped, monkeypatch):
    path = zipped / Small.archive
    path.write_bytes(path.read_bytes()[:-100])
    declare(path, monkeypatch)
    with pytest.raises(DamagedFileError, match=r"ModelNet10\.zip: not a readable zip"):
        Small().shapes(zipped)


def test_a_changed_bit_of_the_directory_is_named_or_changes_nothing(tmp_path, monkeypatch):
    path = tmp_path / Small.archive
    path.parent.mkdir()
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        archive.writestr("ModelNet10/bed/train/bed_0001.off", TRIANGLE)
        archive.writestr("ModelNet10/bed/test/bed_0002.off", GLUED)
    declare(path, monkeypatch)
    faces = {"bed_0001": 1, "bed_0002": 2}
    said = []
    for number, damaged in enumerate(with_a_changed_bit(path.read_bytes())):
        path.write_bytes(damaged)
        os.utime(path, ns=(number, number))  # the clock of the disk may not tell them apart
        for name, count in faces.items():
            try:
                assert len(Small().load(tmp_path, name).faces) == count
            except DamagedFileError as error:
                said.append(str(error))
    assert len(said) > 500
    assert all(str(path) in text and "fetch the database again" in text for text in said)


def test_a_truncated_archive_is_fetched_again(zipped, monkeypatch):
    path = zipped / Small.archive
    whole = path.read_bytes()
    path.write_bytes(whole[:-100])
    assert not Small().available(zipped)
    monkeypatch.setattr(modelnet, "fetch_archive", lambda path, *_: path.write_bytes(whole))
    Small().fetch(zipped)
    assert Small().available(zipped)


def test_some_models_are_not_the_database(tmp_path, data_root):
    samples = data_root / "modelnet10" / "modelnet_samples_off.tar.xz"
    with tarfile.open(samples) as archive:
        archive.extractall(tmp_path, filter="data")
    (tmp_path / "modelnet_samples").rename(tmp_path / "modelnet10")
    assert not ModelNet10().available(tmp_path)
    with pytest.raises(DatasetNotFound, match=r"3991 \+ 908 models to train and test, and 5 are"):
        ModelNet10().shapes(tmp_path)
    assert len(ModelNet10().load(tmp_path, "bathtub_0001").faces) > 1000


def test_a_choice_of_shapes_depends_on_the_seed(zipped):
    chosen = [Small(max_train=1, seed=seed).shapes(zipped) for seed in range(8)]
    for shapes in chosen:
        counts = Counter((shape.label, shape.part) for shape in shapes)
        assert set(counts.values()) == {1}
        assert len(counts) == 4
    assert len(set(chosen)) == 2
    assert Small(max_train=2, max_test=1).shapes(zipped) == Small().shapes(zipped)
