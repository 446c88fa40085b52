"""Archives: verified, bounded, and with errors that name the file and the way out."""

from __future__ import annotations

import hashlib
import tarfile
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest

from gipkg.datasets import archives
from gipkg.datasets.archives import fetch_archive, is_intact, read_members
from gipkg.errors import DatasetNotFound, MeshFormatError
from tests.datasets.tar_files import checksum, write_archive

MEMBERS = {"db/a/1.obj": b"one", "db/b/2.obj": b"two", "db/readme.txt": b"no shape"}


def test_reads_the_members_with_the_suffix_and_writes_nothing(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    assert is_intact(path, sha256)
    assert read_members(path, sha256, ".obj") == {"db/a/1.obj": b"one", "db/b/2.obj": b"two"}
    assert list(tmp_path.iterdir()) == [path]


def test_links_are_not_followed(tmp_path):
    path = tmp_path / "db.tar.gz"
    with tarfile.open(path, "w:gz") as archive:
        link = tarfile.TarInfo("db/secret.obj")
        link.type, link.linkname = tarfile.SYMTYPE, "/etc/hostname"
        archive.addfile(link)
    assert read_members(path, checksum(path), ".obj") == {}


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
    assert set(read_members(path, checksum(path), ".obj")) == {
        "../../out.obj",
        "/tmp/gipkg-out.obj",
    }
    assert [one.name for one in tmp_path.rglob("*")] == ["in", "db.tar.gz"]
    assert not Path("/tmp/gipkg-out.obj").exists()


@pytest.fixture
def served(tmp_path):
    """Address of a folder on this machine, and the folder."""
    folder = tmp_path / "served"
    folder.mkdir()
    handler = partial(SimpleHTTPRequestHandler, directory=folder)
    handler.func.log_message = lambda *_: None
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}", folder
        server.shutdown()
        thread.join()


def test_a_download_is_kept_only_if_its_checksum_fits(tmp_path, served):
    address, folder = served
    sha256 = write_archive(folder / "good.tar.gz", MEMBERS)
    write_archive(folder / "changed.tar.gz", {"db/a/1.obj": b"something else"})
    path = tmp_path / "root" / "db.tar.gz"
    with pytest.raises(
        DatasetNotFound, match=r"(?s)cannot be downloaded.*changed\.tar\.gz \(ValueE"
    ):
        fetch_archive(path, sha256, [f"{address}/changed.tar.gz", f"{address}/missing.tar.gz"])
    assert list(tmp_path.rglob("root/*")) == []
    fetch_archive(path, sha256, [f"{address}/changed.tar.gz", f"{address}/good.tar.gz"])
    assert is_intact(path, sha256)


def test_a_changed_file_is_read_again(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    assert is_intact(path, sha256)
    changed = write_archive(path, {"db/c/3.obj": b"three, and longer than before"})
    assert is_intact(path, changed)
    assert set(read_members(path, changed, ".obj")) == {"db/c/3.obj"}


def test_truncated_archive_names_file_checksum_and_way_out(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.warns(UserWarning, match=r"db\.tar\.gz.*truncated"):
        assert not is_intact(path, sha256)
    with pytest.raises(DatasetNotFound, match=rf"db\.tar\.gz.*{sha256}.*fetch"):
        read_members(path, sha256, ".obj")


def test_missing_archive(tmp_path):
    assert not is_intact(tmp_path / "db.tar.gz", "0" * 64)
    with pytest.raises(DatasetNotFound, match=r"db\.tar\.gz: no such file"):
        read_members(tmp_path / "db.tar.gz", "0" * 64, ".obj")


@pytest.mark.parametrize("keep", [0, 60, 700])
def test_a_file_that_is_no_whole_archive(tmp_path, keep):
    path = tmp_path / "db.tar.gz"
    write_archive(path, {"db/a/1.obj": bytes(hashlib.shake_128(b"").digest(1000))})
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(MeshFormatError, match="not a readable tar archive"):
        read_members(path, checksum(path), ".obj")


def test_members_are_bounded(tmp_path, monkeypatch):
    path = tmp_path / "bomb.tar.gz"
    sha256 = write_archive(path, {"a.obj": bytes(600), "b.obj": bytes(600)})
    monkeypatch.setattr(archives, "MEMORY_LIMIT", 1000)
    with pytest.raises(MeshFormatError, match="more than 1000 bytes"):
        read_members(path, sha256, ".obj")


def test_fetch_falls_back_to_the_second_source(tmp_path, monkeypatch):
    source = tmp_path / "source.tar.gz"
    sha256 = write_archive(source, MEMBERS)
    asked = []

    def retrieve(url, known_hash, fname, path):
        asked.append((url, known_hash))
        if url == "https://first.invalid/db":
            raise ConnectionError("no route")
        Path(path).mkdir()
        (Path(path) / fname).write_bytes(source.read_bytes())

    monkeypatch.setattr("pooch.retrieve", retrieve)
    path = tmp_path / "root" / "db.tar.gz"
    for _ in range(2):
        fetch_archive(path, sha256, ["https://first.invalid/db", "https://second.invalid/db"])
    assert is_intact(path, sha256)
    assert asked == [
        (url, f"sha256:{sha256}")
        for url in ("https://first.invalid/db", "https://second.invalid/db")
    ]
