"""Downloaded files: fetched from where they are published, and known by their SHA-256."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from gipkg.errors import DamagedFileError, DatasetNotFound
from gipkg.files import sha256_of


def is_intact(path: Path, sha256: str) -> bool:
    """Whether a file is there with the SHA-256 given; warns of one that has another.

    The checksum is computed once a process for a file of the same size and time.
    """
    if not path.is_file():
        return False
    fault = _fault(path, sha256)
    if fault:
        warnings.warn(fault, stacklevel=2)
    return not fault


def require_intact(path: Path, sha256: str) -> None:
    """Refuse a file that is not there with the SHA-256 given.

    Raises
    ------
    DatasetNotFound
        It is missing; says the way out.
    DamagedFileError
        It has another checksum; says the way out.
    """
    if not path.is_file():
        raise DatasetNotFound(f"{path}: no such file; gipkg data fetch gets it or says from where")
    if fault := _fault(path, sha256):
        raise DamagedFileError(fault)


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


def version_of(path: Path) -> tuple[Path, int, int]:
    """Return what tells a file from a changed one without reading it: path, bytes and time."""
    status = path.stat()
    return path, status.st_size, status.st_mtime_ns


def _fault(path: Path, sha256: str) -> str | None:
    found = _sha256(*version_of(path))
    if found == sha256:
        return None
    return (
        f"{path}: SHA-256 {found} instead of {sha256}: the file is truncated or of another "
        f"version; delete it and fetch the database again"
    )


@lru_cache(maxsize=32)
def _sha256(path: Path, size: int, modified: int) -> str:
    return sha256_of(path)
