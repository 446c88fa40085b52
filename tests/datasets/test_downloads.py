"""Downloads: kept only if their checksum fits, and named where they are missing or others."""

from __future__ import annotations

from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest

from gipkg.datasets.downloads import fetch_archive, is_intact, require_intact
from gipkg.errors import DamagedFileError, DatasetNotFound
from tests.datasets.tar_files import write_archive

MEMBERS = {"db/a/1.obj": b"one", "db/b/2.obj": b"two", "db/readme.txt": b"no shape"}


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


def test_a_changed_file_is_looked_at_again(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    require_intact(path, sha256)
    changed = write_archive(path, {"db/c/3.obj": b"three, and longer than before"})
    assert is_intact(path, changed)
    require_intact(path, changed)


def test_a_truncated_file_is_named_with_its_checksum_and_the_way_out(tmp_path):
    path = tmp_path / "db.tar.gz"
    sha256 = write_archive(path, MEMBERS)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.warns(UserWarning, match=r"db\.tar\.gz.*truncated"):
        assert not is_intact(path, sha256)
    with pytest.raises(DamagedFileError, match=rf"db\.tar\.gz.*{sha256}.*fetch"):
        require_intact(path, sha256)


def test_a_missing_file(tmp_path):
    assert not is_intact(tmp_path / "db.tar.gz", "0" * 64)
    with pytest.raises(DatasetNotFound, match=r"db\.tar\.gz: no such file"):
        require_intact(tmp_path / "db.tar.gz", "0" * 64)
