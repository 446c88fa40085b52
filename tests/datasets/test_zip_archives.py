"""Zip archives: a member comes back as it was, or the archive is named with the way out."""

from __future__ import annotations

import struct
from pathlib import Path
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZipFile

import pytest

from gipkg.datasets import zip_archives
from gipkg.datasets.zip_archives import read_zip_member, zip_names
from gipkg.errors import DamagedFileError

MEMBERS = {"db/a/1.off": b"one" * 9, "../2.off": b"two"}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "db.zip"
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        for name, content in MEMBERS.items():
            archive.writestr(name, content)
    return path


def test_members_are_listed_and_read_and_nothing_is_written(path: Path) -> None:
    assert zip_names(path) == tuple(MEMBERS)
    assert {name: read_zip_member(path, name) for name in MEMBERS} == MEMBERS
    assert list(path.parent.iterdir()) == [path]
    with pytest.raises(KeyError):
        read_zip_member(path, "db/a/3.off")


def test_a_member_that_takes_too_much_is_refused(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(zip_archives, "MEMBER_LIMIT", 10)
    assert read_zip_member(path, "../2.off") == b"two"
    with pytest.raises(DamagedFileError, match=r"db\.zip: .*1\.off.*27 bytes; at most 10"):
        read_zip_member(path, "db/a/1.off")


def test_packed_in_another_way_than_the_directory_says(path: Path) -> None:
    content = bytearray(path.read_bytes())
    struct.pack_into("<H", content, content.index(b"PK\1\2") + 10, ZIP_BZIP2)
    path.write_bytes(content)
    with pytest.raises(DamagedFileError, match=r"db\.zip: .*1\.off.*delete it and fetch"):
        read_zip_member(path, "db/a/1.off")


def test_what_is_no_archive(tmp_path: Path) -> None:
    (tmp_path / "db.zip").write_bytes(b"PK")
    with pytest.raises(DamagedFileError, match=r"db\.zip: not a readable zip archive.*delete it"):
        zip_names(tmp_path / "db.zip")
