"""Damaged zip archives, ``.npz`` files among them: one error for all that a changed bit can do."""

from __future__ import annotations

import errno
import lzma
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from gipkg.errors import DamagedFileError

_LOCAL_HEADER = struct.Struct("<26xHH")
"""What stands before a member: how long its name is, and an extra field, which both follow."""


@contextmanager
def damage_as_value_error() -> Iterator[None]:
    """Turn whatever Python's reader raises of a damaged archive into a ValueError.

    A changed bit of the directory can make a member encrypted, packed in another or an unknown
    way, or begin before the file does. Faults of the disk stay what they are.
    """
    try:
        yield
    except (EOFError, RuntimeError, zipfile.BadZipFile, zlib.error, lzma.LZMAError) as error:
        raise ValueError(str(error) or "it ends early") from error
    except OSError as error:
        if error.errno == errno.EINVAL:
            raise ValueError("a member begins before the file does") from error
        if error.errno is None:  # bzip2 says so that it cannot unpack something
            raise ValueError(str(error)) from error
        raise


@contextmanager
def naming_damage(path: Path, fault: str, way_out: str) -> Iterator[None]:
    """Name an archive that turns out to be damaged.

    Parameters
    ----------
    path : Path
    fault : str
        What it is not, such as ``not a whole shard``.
    way_out : str
        What to do when it is deleted.

    Raises
    ------
    DamagedFileError
        The block raises what a damaged archive leads to, a ValueError or a KeyError among it.
    """
    try:
        with damage_as_value_error():
            yield
    except (ValueError, KeyError) as error:
        raise DamagedFileError(f"{path}: {fault} ({error}); delete it and {way_out}") from error


def require_whole_directory(path: Path) -> None:
    """Refuse an archive of ours whose directory does not tell what lies in the file.

    Each member begins where the one before ends, and has its name before its content, too. A
    changed bit of the directory could otherwise rename or hide one, which nobody would miss.

    Parameters
    ----------
    path : Path
        An archive that was written to a file, member by member. Others may leave gaps.

    Raises
    ------
    ValueError
        The directory is damaged.
    """
    with damage_as_value_error(), zipfile.ZipFile(path) as archive, path.open("rb") as stream:
        end = 0
        for member in archive.infolist():
            stream.seek(end)
            header = stream.read(_LOCAL_HEADER.size)
            if member.header_offset != end or len(header) < _LOCAL_HEADER.size:
                raise ValueError(f"{member.filename!r} is not where its directory says")
            name, extra = _LOCAL_HEADER.unpack(header)
            if stream.read(name).decode() != member.orig_filename:
                raise ValueError(f"{member.filename!r} has another name in its directory")
            end += _LOCAL_HEADER.size + name + extra + member.compress_size
        if end != archive.start_dir:
            raise ValueError("its directory leaves members out")
