"""Downloaded archives: verified once, read without unpacking them to disk."""

from __future__ import annotations

import gzip
import hashlib
import lzma
import tarfile
import warnings
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from gipkg.errors import DatasetNotFound, MeshFormatError

MEMORY_LIMIT = 256 * 2**20
"""Bytes that the members of one archive may take together, unpacked."""


def is_intact(path: Path, sha256: str) -> bool:
    """Whether an archive is there with the SHA-256 given; warns of one that has another.

    The checksum is computed once a process for a file of the same size and time.
    """
    if not path.is_file():
        return False
    found = _sha256(*_version(path))
    if found != sha256:
        warnings.warn(_damage(path, found, sha256), stacklevel=2)
    return found == sha256


def read_members(path: Path, sha256: str, suffix: str) -> Mapping[str, bytes]:
    """Contents of the files in a tar archive whose name ends in `suffix`, by member name.

    Read once a process and kept in memory; nothing is written to disk.

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
        The archive is missing, or is not the one that `sha256` names.
    MeshFormatError
        It is no tar archive, or its members take more than `MEMORY_LIMIT`.
    """
    if not path.is_file():
        raise DatasetNotFound(f"{path}: no such file; fetch the database, or put the archive there")
    found = _sha256(*_version(path))
    if found != sha256:
        raise DatasetNotFound(_damage(path, found, sha256))
    return _read_members(*_version(path), suffix)


def fetch_archive(path: Path, sha256: str, sources: Sequence[str]) -> None:
    """Download an archive from the first of its sources that has it, unless it is there.

    Parameters
    ----------
    path : Path
        Where to put it; its folder is made.
    sha256 : str
        Its checksum; a download with another one is discarded.
    sources : sequence of str
        Addresses, tried in order.

    Raises
    ------
    DatasetNotFound
        No source has it, or its folder cannot be written to.
    """
    import pooch

    if is_intact(path, sha256):
        return
    failures = []
    for source in sources:
        try:
            pooch.retrieve(source, known_hash=f"sha256:{sha256}", fname=path.name, path=path.parent)
        # pooch passes on the errors of its transport, and ValueError for a wrong checksum.
        except (OSError, ValueError) as error:
            failures.append(f"  {source} ({type(error).__name__}: {error})")
        else:
            return
    raise DatasetNotFound(
        f"{path.name} cannot be downloaded. Put it in {path.parent}, from one of\n"
        + "\n".join(failures)
    )


def _damage(path: Path, found: str, wanted: str) -> str:
    return (
        f"{path}: SHA-256 {found} instead of {wanted}: the file is truncated or of another "
        f"version; delete it and fetch the database again"
    )


def _version(path: Path) -> tuple[Path, int, int]:
    status = path.stat()
    return path, status.st_size, status.st_mtime_ns


@lru_cache(maxsize=32)
def _sha256(path: Path, size: int, modified: int) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


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
    except (tarfile.TarError, EOFError, gzip.BadGzipFile, lzma.LZMAError) as error:
        raise MeshFormatError(
            path, f"not a readable tar archive ({error}); fetch it again"
        ) from error
    return MappingProxyType(contents)
