"""Small tar archives for the tests."""

from __future__ import annotations

import hashlib
import io
import tarfile
from pathlib import Path


def write_archive(path: Path, members: dict[str, bytes]) -> str:
    """Write a tar.gz archive; return its SHA-256."""
    with tarfile.open(path, "w:gz") as archive:
        for name, content in members.items():
            info = tarfile.TarInfo(name)
            info.size = len(content)
            archive.addfile(info, io.BytesIO(content))
    return checksum(path)


def checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
