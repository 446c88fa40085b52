"""Tar archives: members are read to memory, bounded, with errors that name the way out."""

from __future__ import annotations

import hashlib
import tarfile
from pathlib import Path

import pytest

from gipkg.datasets import tar_archives
from gipkg.datasets.tar_archives import read_tar_members
from gipkg.errors import DamagedFileError, MeshFormatError
from tests.datasets.tar_files import checksum, write_archive

MEMBERS = {"db/a/1.obj": b"one", "db/b/2.obj": b"two", "db/readme.txt": b"no shape"}


def test_reads_the_members_with_the_suffix_and_writes_nothing(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    assert read_tar_members(path, sha256, ".obj") == {"db/a/1.obj": b"one", "db/b/2.obj": b"two"}
    assert list(tmp_path.iterdir()) == [path]


def test_links_are_not_followed(tmp_path):
    path = tmp_path / "db.tar.gz"
    with tarfile.open(path, "w:gz") as archive:
        link = tarfile.TarInfo("db/secret.obj")
        link.type, link.linkname = tarfile.SYMTYPE, "/etc/hostname"
        archive.addfile(link)
    assert read_tar_members(path, checksum(path), ".obj") == {}


def test_members_that_are_no_files_or_lead_elsewhere_write_nothing(tmp_path):
    path = tmp_path / "in" / "db.tar.gz"
    path.parent.mkdir()
    with tarfile.open(path, "w:gz") as archive:
        for kind in (tarfile.LNKTYPE, tarfile.CHRTYPE, tarfile.FIFOTYPE, tarfile.DIRTYPE):
            member = tarfile.TarInfo("db/odd.obj")
            member.type, member.linkname = kind, "/etc/hostname"
            archive.addfile(member)
        for name in ("../../out.obj", "/tmp/gipkg-out.obj"):
            archive.addfile(tarfile.TarInfo(name))
    assert set(read_tar_members(path, checksum(path), ".obj")) == {
        "../../out.obj",
        "/tmp/gipkg-out.obj",
    }
    assert [one.name for one in tmp_path.rglob("*")] == ["in", "db.tar.gz"]
    assert not Path("/tmp/gipkg-out.obj").exists()


def test_a_changed_file_is_read_again(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    assert len(read_tar_members(path, sha256, ".obj")) == 2
    changed = write_archive(path, {"db/c/3.obj": b"three, and longer than before"})
    assert set(read_tar_members(path, changed, ".obj")) == {"db/c/3.obj"}


def test_an_archive_with_another_checksum_is_not_read(tmp_path):
    path = tmp_path / "db.tar.gz"
    write_archive(path, MEMBERS)
    with pytest.raises(DamagedFileError, match=r"db\.tar\.gz: SHA-256"):
        read_tar_members(path, "0" * 64, ".obj")


@pytest.mark.parametrize("keep", [0, 60, 700])
def test_a_file_that_is_no_whole_archive(tmp_path, keep):
    path = tmp_path / "db.tar.gz"
    write_archive(path, {"db/a/1.obj": bytes(hashlib.shake_128(b"").digest(1000))})
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(MeshFormatError, match="not a readable tar archive"):
        read_tar_members(path, checksum(path), ".obj")


def test_members_are_bounded(tmp_path, monkeypatch):
    path = tmp_path / "bomb.tar.gz"
    sha256 = write_archive(path, {"a.obj": bytes(600), "b.obj": bytes(600)})
    monkeypatch.setattr(tar_archives, "MEMORY_LIMIT", 1000)
    with pytest.raises(MeshFormatError, match="more than 1000 bytes"):
        read_tar_members(path, sha256, ".obj")
