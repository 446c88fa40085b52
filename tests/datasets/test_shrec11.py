"""SHREC'11: the real archive whole, and what happens without it."""

from __future__ import annotations

import socket
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from gipkg.datasets import shrec11, split
from gipkg.datasets.shrec11 import ARCHIVE, Shrec11
from gipkg.errors import DatasetNotFound, MeshFormatError
from tests.datasets.tar_files import write_archive


@pytest.fixture(scope="module")
def root(data_root: Path) -> Path:
    if not Shrec11().available(data_root):
        pytest.skip(f"no {ARCHIVE} under {data_root}")
    return data_root


@pytest.fixture
def tampered(tmp_path, monkeypatch):
    """Data root whose archive holds two members of our own."""
    path = tmp_path / ARCHIVE
    path.parent.mkdir()
    broken = b"v 0 0 0\nf 1 2 x//\n"
    sha256 = write_archive(
        path, {"shrec_16/a/train/T1.obj": broken, "shrec_16/a/test/T2.obj": b"v 0 0 0\n"}
    )
    monkeypatch.setattr(shrec11, "SHA256", sha256)
    return tmp_path


def test_thirty_classes_of_twenty(root):
    shapes = Shrec11().shapes(root)
    assert {shape.id for shape in shapes} == {f"T{number}" for number in range(600)}
    assert [shape.id for shape in shapes] == sorted(shape.id for shape in shapes)
    assert set(Counter(shape.label for shape in shapes).values()) == {20}
    assert len({shape.label for shape in shapes}) == Shrec11.tags.classes == 30


def test_classes_are_those_of_the_contest(root):
    official = {}
    for line in (root / "shrec11" / "categories.txt").read_text().splitlines()[2:]:
        words = line.split()
        if len(words) == 3:
            label = words[0].removesuffix("_test")
        elif words:
            official[f"T{words[0]}"] = label
    assert {shape.id: shape.label for shape in Shrec11().shapes(root)} == official


def test_all_meshes_are_closed_and_twelve_are_of_genus_one(root):
    dataset = Shrec11()
    genus_one = Counter()
    for shape in dataset.shapes(root):
        mesh = dataset.load(root, shape.id)
        assert len(mesh.faces) == 500
        assert 250 <= len(mesh.vertices) <= 252
        assert mesh.is_watertight
        assert mesh.body_count == 1
        if mesh.euler_number != 2:
            assert mesh.euler_number == 0
            genus_one[shape.label] += 1
    assert genus_one == {"alien": 7, "dog1": 2, "cat": 1, "man": 1, "woman": 1}


def test_vertices_keep_the_order_of_the_file(root):
    content = shrec11.read_tar_members(root / ARCHIVE, shrec11.SHA256, ".obj")
    member = next(name for name in content if name.endswith("/T7.obj"))
    lines = [line.split() for line in content[member].decode().splitlines()]
    mesh = Shrec11().load(root, "T7")
    vertices = np.array([line[1:4] for line in lines if line and line[0] == "v"], float)
    faces = [[w.split("/")[0] for w in line[1:4]] for line in lines if line and line[0] == "f"]
    np.testing.assert_array_equal(mesh.vertices, vertices)
    np.testing.assert_array_equal(mesh.faces, np.array(faces, int) - 1)


def test_protocols_split_every_class(root):
    shapes = Shrec11().shapes(root)
    for name, sizes in {"SHREC1": (300, 300), "SHREC2": (480, 120)}.items():
        train, test = split(shapes, Shrec11.protocols[name], seed=0)
        assert (len(train), len(test)) == sizes


def test_unknown_shape(root):
    with pytest.raises(DatasetNotFound, match="no shape 'T600'"):
        Shrec11().load(root, "T600")


@pytest.mark.parametrize("number", [1, 2])
def test_unreadable_member_is_named(tampered, number):
    with pytest.raises(MeshFormatError, match=rf"shrec_16/a/.*/T{number}\.obj"):
        Shrec11().load(tampered, f"T{number}")


def test_without_network_fetch_names_addresses_and_folder(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise socket.gaierror("no network in this test")

    monkeypatch.setattr(socket, "getaddrinfo", refuse)
    dataset = Shrec11()
    assert not dataset.available(tmp_path)
    with pytest.raises(DatasetNotFound) as caught:
        dataset.fetch(tmp_path)
    for clue in (*shrec11.SOURCES, str(tmp_path / "shrec11"), "shrec_16.tar.gz"):
        assert clue in str(caught.value)
    with pytest.raises(DatasetNotFound, match=r"shrec_16\.tar\.gz: no such file"):
        dataset.shapes(tmp_path)


def test_nothing_is_fetched_when_it_is_there(root, monkeypatch):
    monkeypatch.setattr("pooch.retrieve", lambda *_, **__: pytest.fail("went to the network"))
    Shrec11().fetch(root)
