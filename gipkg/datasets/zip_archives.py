"""Zip archives: a member is read when it is asked for; nothing is unpacked to disk."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from zipfile import ZipFile

from gipkg.datasets.downloads import version_of
from gipkg.zip_damage import naming_damage

MEMBER_LIMIT = 256 * 2**20
"""Bytes that one member may take, unpacked."""

_WAY_OUT = "fetch the database again"


def zip_names(path: Path) -> tuple[str, ...]:
    """Names of the members of a zip archive, in its order; their contents are not read.

    Raises
    ------
    DamagedFileError
        It is no zip archive, or ends early.
    """
    return tuple(_open(path).namelist())


def read_zip_member(path: Path, name: str) -> bytes:
    """Read one member of a zip archive; its checksum in the archive is verified.

    Raises
    ------
    KeyError
        There is no such member; a damaged archive may have lost its name.
    DamagedFileError
        It is damaged or encrypted, or takes more than `MEMBER_LIMIT`.
    """
    archive = _open(path)
    member = archive.getinfo(name)
    with naming_damage(path, f"{name} in it is not readable", _WAY_OUT):
        if member.file_size > MEMBER_LIMIT:
            raise ValueError(f"{member.file_size} bytes; at most {MEMBER_LIMIT} are read")
        return archive.read(member)


def _open(path: Path) -> ZipFile:
    return _open_once(*version_of(path), os.getpid())


@lru_cache(maxsize=2)
def _open_once(path: Path, size: int, modified: int, process: int) -> ZipFile:
    """Read the directory of an archive once.

    Its file stays open. A process that was forked opens its own: the two would otherwise share
    one position in the file.
    """
    with naming_damage(path, "not a readable zip archive", _WAY_OUT):
        return ZipFile(path)
