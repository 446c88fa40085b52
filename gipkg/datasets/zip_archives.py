"""Zip archives: a member is read when it is asked for; nothing is unpacked to disk."""

from __future__ import annotations

import os
import zlib
from functools import lru_cache
from pathlib import Path
from zipfile import BadZipFile, ZipFile

from gipkg.datasets.downloads import version_of
from gipkg.errors import MeshFormatError

MEMBER_LIMIT = 256 * 2**20
"""Bytes that one member may take, unpacked."""


def zip_names(path: Path) -> tuple[str, ...]:
    """Names of the members of a zip archive, in its order; their contents are not read.

    Raises
    ------
    MeshFormatError
        It is no zip archive, or ends early.
    """
    return tuple(_open(path).namelist())


def read_zip_member(path: Path, name: str) -> bytes:
    """Read one member of a zip archive; its checksum in the archive is verified.

    Raises
    ------
    KeyError
        There is no such member.
    MeshFormatError
        It is damaged or encrypted, or takes more than `MEMBER_LIMIT`.
    """
    archive = _open(path)
    size = archive.getinfo(name).file_size
    if size > MEMBER_LIMIT:
        raise MeshFormatError(path / name, f"{size} bytes; at most {MEMBER_LIMIT} are read")
    try:
        return archive.read(name)
    # An encrypted member is a RuntimeError, an unknown compression a NotImplementedError.
    except (BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError) as error:
        raise MeshFormatError(
            path / name, f"not readable in the archive ({error}); fetch it again"
        ) from error


def _open(path: Path) -> ZipFile:
    return _open_once(*version_of(path), os.getpid())


@lru_cache(maxsize=2)
def _open_once(path: Path, size: int, modified: int, process: int) -> ZipFile:
    """Read the directory of an archive once.

    Its file stays open. A process that was forked opens its own: the two would otherwise share
    one position in the file.
    """
    try:
        return ZipFile(path)
    except (BadZipFile, NotImplementedError) as error:
        raise MeshFormatError(
            path, f"not a readable zip archive ({error}); fetch it again"
        ) from error
