"""Damaged archives are a ValueError, whatever is damaged, and lose no member unnoticed."""

from __future__ import annotations

import errno
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest

from gipkg.errors import DamagedFileError
from gipkg.files import write_arrays
from gipkg.zip_damage import damage_as_value_error, naming_damage, require_whole_directory
from tests.support.zip_bits import with_a_changed_bit

METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA)


@pytest.mark.parametrize("method", METHODS)
def test_a_changed_bit_of_the_directory_is_a_value_error_or_renames(
    tmp_path: Path, method: int
) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", method) as archive:
        archive.writestr(zipfile.ZipInfo("a"), b"content" * 9, method)
    outcomes = set()
    for damaged in with_a_changed_bit(path.read_bytes()):
        path.write_bytes(damaged)
        try:
            with damage_as_value_error(), zipfile.ZipFile(path) as archive:
                assert archive.read("a") == b"content" * 9
            outcomes.add("whole")
        except (ValueError, KeyError) as error:
            outcomes.add(type(error).__name__)
    assert outcomes == {"whole", "ValueError", "KeyError"}


@pytest.mark.parametrize("method", METHODS[1:])
def test_packed_otherwise_than_the_directory_says(tmp_path: Path, method: int) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a", b"content" * 9)
    content = bytearray(path.read_bytes())
    if method == zipfile.ZIP_DEFLATED:
        content[content.index(b"a", 26) + 1] ^= 0xFF
    struct.pack_into("<H", content, content.index(b"PK\1\2") + 10, method)
    path.write_bytes(content)
    with (
        pytest.raises(ValueError, match=r"."),
        damage_as_value_error(),
        zipfile.ZipFile(path) as archive,
    ):
        archive.read("a")


def test_a_fault_of_the_disk_stays_one() -> None:
    with pytest.raises(OSError, match="full"), damage_as_value_error():
        raise OSError(errno.ENOSPC, "the disk is full")


def test_what_is_damaged_is_named_with_the_way_out() -> None:
    expected = r"^a\.npz: not a whole shard \(.*gone.*\); delete it and run the command again$"
    for error in (KeyError("it is gone"), EOFError("it is gone")):
        with (
            pytest.raises(DamagedFileError, match=expected),
            naming_damage(Path("a.npz"), "not a whole shard", "run the command again"),
        ):
            raise error


def test_a_whole_directory_is_that_of_all_members(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    write_arrays(path, {"one": np.arange(3), "two": np.eye(2)})
    require_whole_directory(path)
    whole = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    survived = 0
    for damaged in with_a_changed_bit(whole):
        path.write_bytes(damaged)
        try:
            require_whole_directory(path)
        except ValueError:
            continue
        survived += 1
        with zipfile.ZipFile(path) as archive:
            assert archive.namelist() == names
    assert survived


def test_a_member_that_is_hidden_or_missing_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    write_arrays(path, {"one": np.arange(3), "two": np.eye(2)})
    content = path.read_bytes()
    first = content.index(b"PK\1\2")
    second = content.index(b"PK\1\2", first + 1)
    hidden = bytearray(content)  # in the comment of the one before
    end = content.index(b"PK\5\6")
    struct.pack_into("<H", hidden, first + 32, end - second)
    path.write_bytes(hidden)
    with pytest.raises(ValueError, match="leaves members out"):
        require_whole_directory(path)
    path.write_bytes(content[:10])
    with pytest.raises(ValueError, match="not a zip file"):
        require_whole_directory(path)
