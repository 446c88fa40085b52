"""NumPy's files are read as numbers, whatever they claim to be."""

from __future__ import annotations

import io
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from gipkg.files import write_arrays
from gipkg.formats.arrays import array_names, read_array, read_arrays
from tests.support.zip_bits import with_a_changed_bit_of_a_header

DTYPES = st.sampled_from(["<f8", ">f4", "<i4", "|u1", "?"])
ARRAYS = arrays.arrays(DTYPES, arrays.array_shapes(min_dims=0, max_dims=3, min_side=0))


@settings(max_examples=30)
@given(ARRAYS, st.booleans())
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory, array: np.ndarray, by_columns: bool
) -> None:
    path = tmp_path_factory.mktemp("arrays") / "a.npy"
    np.save(path, np.asfortranarray(array) if by_columns else array)
    read = read_array(path)
    assert read.dtype == array.dtype
    np.testing.assert_array_equal(read, array)


def test_several_arrays_in_one_file(tmp_path: Path) -> None:
    write_arrays(tmp_path / "a.npz", {"one": np.arange(3), "two": np.eye(2)})
    read = read_arrays(tmp_path / "a.npz")
    assert set(read) == {"one", "two"}
    np.testing.assert_array_equal(read["two"], np.eye(2))
    assert array_names(tmp_path / "a.npz") == ("one", "two")
    assert set(read_arrays(tmp_path / "a.npz", ["two"])) == {"two"}
    with pytest.raises(KeyError, match="three"):
        read_arrays(tmp_path / "a.npz", ["three"])


def test_a_changed_bit_of_a_header_is_found_even_where_it_asks_for_less(tmp_path: Path) -> None:
    # Of more than is read ahead, so that the checksum is not tested by chance.
    path = tmp_path / "a.npz"
    write_arrays(path, {"long": np.arange(6000.0).reshape(2000, 3)})
    bits = list(with_a_changed_bit_of_a_header(path.read_bytes()))
    assert len(bits) == 128 * 8
    for damaged in bits:
        path.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"."):
            read_arrays(path)


def test_what_follows_an_array_is_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.eye(3))
    with (tmp_path / "a.npy").open("ab") as stream:
        stream.write(b"more")
    with pytest.raises(ValueError, match="more than its header says"):
        read_array(tmp_path / "a.npy")


def test_objects_are_refused_and_never_made(tmp_path: Path) -> None:
    class Bomb:
        def __reduce__(self) -> tuple:
            return (Path.touch, (tmp_path / "went-off",))

    np.save(tmp_path / "a.npy", np.array([Bomb()], dtype=object), allow_pickle=True)
    with pytest.raises(ValueError, match="Python objects"):
        read_array(tmp_path / "a.npy")
    assert not (tmp_path / "went-off").exists()


def test_a_header_that_asks_for_more_than_there_is(tmp_path: Path) -> None:
    stream = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (1 << 40,)}
    np.lib.format.write_array_header_1_0(stream, header)
    (tmp_path / "a.npy").write_bytes(stream.getvalue())
    with pytest.raises(ValueError, match=r"asks for \d+ bytes, the file has"):
        read_array(tmp_path / "a.npy")


def test_an_archive_that_unpacks_to_more_than_it_is(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "a.npz", zeros=np.zeros(1 << 20))
    with pytest.raises(ValueError, match="is compressed"):
        read_arrays(tmp_path / "a.npz")


def test_members_that_lie_on_each_other_do_not_make_more_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    write_arrays(path, {"one": np.zeros(100)})
    content = path.read_bytes()
    start = content.index(b"PK\x01\x02")
    end = content.index(b"PK\x05\x06")
    entry, tail = content[start:end], bytearray(content[end:])
    # A directory of ten entries, of which each is the one member.
    struct.pack_into("<HHI", tail, 8, 10, 10, 10 * len(entry))
    path.write_bytes(content[:start] + 10 * entry + tail)
    with pytest.raises(ValueError, match=r"Overlapped|asks for"):
        read_arrays(path)


@settings(max_examples=100)
@given(st.data())
def test_damage_is_a_value_error_or_reads_as_numbers(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    path = tmp_path_factory.mktemp("arrays") / "a.npz"
    write_arrays(path, {"one": np.arange(3)})
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(1, len(content)))])
    try:
        read = read_arrays(path)
    except ValueError:
        return
    assert all(array.dtype.kind != "O" for array in read.values())
