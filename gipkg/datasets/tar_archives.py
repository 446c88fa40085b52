"""Tar archives: all members wanted are read at once; nothing is unpacked to disk."""

from __future__ import annotations

import gzip
import lzma
import tarfile
import zlib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from gipkg.datasets.downloads import require_intact, version_of
from gipkg.errors import MeshFormatError

MEMORY_LIMIT = 256 * 2**20
"""Bytes that the members of one archive may take together, unpacked."""


def read_tar_members(path: Path, sha256: str, suffix: str) -> Mapping[str, bytes]:
    """Contents of the files in a tar archive whose name ends in `suffix`, by member name.

    Read once a process and kept in memory.

    Parameters
    ----------
    path : Path
        A tar archive, compressed or not.
    sha256 : str
        Its checksum, in hexadecimal.
    suffix : str
        End of the member names wanted, such as ``.obj``.

    Raises
    ------
    DatasetNotFound
        The archive is missing.
    DamagedFileError
        It is not the one that `sha256` names.
    MeshFormatError
        It is no tar archive, or its members take more than `MEMORY_LIMIT`.
    """
    require_intact(path, sha256)
    return _read_members(*version_of(path), suffix)


@lru_cache(maxsize=2)
def _read_members(path: Path, size: int, modified: int, suffix: str) -> Mapping[str, bytes]:
    contents: dict[str, bytes] = {}
    free = MEMORY_LIMIT
    try:
        with tarfile.open(path) as archive:
            for member in archive:
                if not (member.isfile() and member.name.endswith(suffix)):
                    continue
                free -= member.size
                if free < 0:
                    raise MeshFormatError(
                        path, f"more than {MEMORY_LIMIT} bytes in *{suffix}; not the right archive"
                    )
                file = archive.extractfile(member)
                assert file is not None  # a regular file
                contents[member.name] = file.read()
    except (tarfile.TarError, EOFError, gzip.BadGzipFile, lzma.LZMAError, zlib.error) as error:
        raise MeshFormatError(
            path, f"not a readable tar archive ({error}); fetch it again"
        ) from error
    return MappingProxyType(contents)
