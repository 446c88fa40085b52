"""An index comes back from its file, knows its meshes by their content, and finds the nearest."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from gipkg.errors import DamagedFileError, UnsupportedMesh
from gipkg.search.index import Entry, Index, mesh_files
from gipkg.search.network import Signature, SignatureNetwork
from tests.support.zip_bits import with_a_changed_bit


def index_of(table: np.ndarray, **others: Entry) -> Index:
    signatures = [
        Signature(row.astype(np.float32), f"class {n % 2}") for n, row in enumerate(table)
    ]
    entries = {f"{n}.off": Entry(f"digest {n}", one) for n, one in enumerate(signatures)}
    return Index("key", b"network", "..", {**entries, **others})


@settings(max_examples=25)
@given(
    arrays.arrays(
        np.float32, st.tuples(st.integers(0, 5), st.just(3)), elements=st.floats(-9, 9, width=32)
    )
)
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, table: np.ndarray
) -> None:
    path = tmp_path_factory.mktemp("index") / "a.npz"
    known = index_of(table, **{"bad $1.ply": Entry("digest", "it is open")})
    known.write(path)
    again = Index.read(path)
    assert (again.key, again.network, again.folder) == ("key", b"network", "..")
    assert again.entries.keys() == known.entries.keys()
    assert again.entries["bad $1.ply"] == Entry("digest", "it is open")
    content = path.read_bytes()
    again.write(path)
    assert path.read_bytes() == content


@settings(max_examples=25)
@given(
    arrays.arrays(np.float32, (6, 3), elements=st.integers(-2, 2)),
    arrays.arrays(np.float32, 3, elements=st.integers(-2, 2)),
    st.integers(1, 8),
)
def test_the_nearest_are_those_of_a_full_sort(
    table: np.ndarray, query: np.ndarray, count: int
) -> None:
    hits = index_of(table).nearest(query, count)
    expected = sorted(
        (float(np.linalg.norm(row - query)), f"{n}.off") for n, row in enumerate(table)
    )
    assert [hit.name for hit in hits] == [name for _, name in expected[:count]]
    np.testing.assert_allclose([hit.distance for hit in hits], [d for d, _ in expected[:count]])


def test_an_empty_index_finds_nothing() -> None:
    assert Index("key", b"").nearest(np.zeros(3, np.float32), 5) == []


@pytest.mark.parametrize("name", ["../a.off", "/etc/a.off", "a/../../b.off", ""])
def test_a_name_that_leads_out_of_the_folder_is_refused(tmp_path: Path, name: str) -> None:
    index_of(np.zeros((1, 3)), **{name: Entry("digest", "a reason")}).write(tmp_path / "a.npz")
    with pytest.raises(DamagedFileError, match="outside of the folder"):
        Index.read(tmp_path / "a.npz")


@settings(max_examples=60)
@given(st.data())
def test_damage_is_named(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    path = tmp_path_factory.mktemp("index") / "a.npz"
    index_of(np.eye(3)).write(path)
    content = bytearray(path.read_bytes())
    content[data.draw(st.integers(0, len(content) - 1))] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content[: data.draw(st.integers(len(content) - 9, len(content)))])
    try:
        read = Index.read(path)
    except DamagedFileError:
        pass
    else:
        assert read.entries.keys() == index_of(np.eye(3)).entries.keys()


def test_a_changed_bit_of_the_directory_is_named_or_changes_nothing(tmp_path: Path) -> None:
    path, known = tmp_path / "a.npz", index_of(np.eye(3))
    known.write(path)
    found = 0
    for damaged in with_a_changed_bit(path.read_bytes()):
        path.write_bytes(damaged)
        try:
            again = Index.read(path)
        except DamagedFileError:
            found += 1
            continue
        assert (again.key, again.network, again.folder) == (known.key, known.network, known.folder)
        assert again.entries.keys() == known.entries.keys()
        for name, entry in known.entries.items():
            np.testing.assert_equal(vars(again.entries[name].outcome), vars(entry.outcome))
    assert found > 500


def test_there_is_no_index() -> None:
    with pytest.raises(DamagedFileError, match="no such file; gipkg index makes one"):
        Index.read(Path("absent.npz"))


def test_meshes_are_found_below_and_sorted(tmp_path: Path) -> None:
    for name in ("b/c.PLY", "a.off", "b/a.obj", "notes.txt", ".hidden/a.off", "b/.x.stl"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "folder.off").mkdir()
    assert list(mesh_files(tmp_path)) == ["a.off", "b/a.obj", "b/c.PLY"]


def test_a_mesh_is_described_again_only_when_its_file_has_changed(
    network_file: Path, folder: Path
) -> None:
    network = SignatureNetwork.read(network_file)
    index = Index(network.key, network.content)
    path = folder / "needles" / "1.off"
    first = index.update("it", path, network)
    assert index.update("it", path, network) is first
    path.write_bytes(path.read_bytes() + b"\n")
    second = index.update("it", path, network)
    assert second is not first
    np.testing.assert_array_equal(second.embedding, first.embedding)
    shutil.copy(folder / "plates" / "1.off", path)
    assert np.abs(index.update("it", path, network).embedding - first.embedding).max() > 0.01


def test_a_bad_mesh_stays_named_until_its_file_changes(network_file: Path, folder: Path) -> None:
    network = SignatureNetwork.read(network_file)
    index = Index(network.key, network.content)
    path = folder / "bad.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    for _ in range(2):
        with pytest.raises(UnsupportedMesh, match="does not exist"):
            index.update("bad.off", path, network)
    shutil.copy(folder / "plates" / "1.off", path)
    assert index.update("bad.off", path, network).label == "plates"
