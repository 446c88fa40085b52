"""Files that are there whole or not at all, whatever moment a process is killed at."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import secrets
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from hashlib import file_digest, sha256
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from gipkg.errors import DamagedFileError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_SEAL = re.compile(r"(?P<lines>.*\n)# sha256 (?P<digest>[0-9a-f]{64})\n", re.DOTALL)


@contextmanager
def atomic(path: Path) -> Iterator[IO[bytes]]:
    """Open a binary file that appears under its name only when the block has ended well.

    The content goes to a temporary file in the same folder, is flushed to the disk and then
    renamed, so that a reader sees the old file or the new one. Where the block raises, the
    temporary file is removed and nothing else has changed.

    Parameters
    ----------
    path : Path
        Name of the file; missing folders are made.

    Yields
    ------
    binary file
        Open for writing and reading.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with part.open("x+b") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        part.replace(path)
    except BaseException as error:
        with suppress(OSError):
            part.unlink()
        if isinstance(error, OSError) and error.errno and error.filename is None:
            error.filename = str(path)  # the disk is full: where was that?
        raise


def sha256_of(path: Path) -> str:
    """Return the SHA-256 of a file's content, 64 hexadecimal digits; it is not held in memory."""
    with path.open("rb") as stream:
        return file_digest(stream, "sha256").hexdigest()


def write_text(path: Path, text: str) -> None:
    """Write a text as UTF-8, atomically."""
    with atomic(path) as stream:
        stream.write(text.encode())


def write_json(path: Path, content: Any, *, sealed: bool = False) -> None:
    """Write a JSON document with sorted keys, atomically; the same content, the same bytes.

    A sealed one is an object of its ``content`` and that one's ``sha256``, so that a changed
    letter is noticed: for what a later job builds upon.
    """
    if sealed:
        content = {"content": content, "sha256": _digest(content)}
    write_text(path, _dump(content))


def write_csv(
    path: Path, header: Sequence[str], rows: Iterable[Sequence[object]], *, sealed: bool = False
) -> None:
    """Write a table of comma-separated values, atomically.

    It ends with an empty line, which readers of such tables skip: one that is cut off anywhere,
    between two lines too, has none and is not taken for whole. A sealed one ends with a comment
    instead, the SHA-256 of the lines before, so that a changed letter is noticed as well: for
    what a later job builds upon, not for tables that people load elsewhere.

    Raises
    ------
    ValueError
        A row is shorter or longer than the header.
    """
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(header)
    for row in rows:
        if len(row) != len(header):
            raise ValueError(f"{path}: {row!r} has {len(row)} values for {len(header)} columns")
        writer.writerow(row)
    lines = buffer.getvalue()
    end = f"# sha256 {sha256(lines.encode()).hexdigest()}" if sealed else ""
    write_text(path, f"{lines}{end}\n")


def read_csv(path: Path) -> list[dict[str, str]]:
    """Read a table written by :func:`write_csv`, a mapping from column to value for each row.

    Raises
    ------
    DamagedFileError
        The empty line at its end is missing, or its checksum does not fit, or a row has more or
        fewer values than there are columns.
    """
    text = path.read_bytes().decode("utf-8", "replace")
    whole = text.endswith("\n\n")
    if seal := _SEAL.fullmatch(text):
        text = seal["lines"]
        whole = sha256(text.encode()).hexdigest() == seal["digest"]
    try:
        rows = list(csv.DictReader(io.StringIO(text, newline=""), strict=True))
    except csv.Error:
        whole = False
    if not whole or any(None in row or None in row.values() for row in rows):
        raise DamagedFileError(f"{path}: not a whole table; delete it and run the command again")
    return rows


def read_json(path: Path, *, sealed: bool = False) -> Any:
    """Read a document written by :func:`write_json`.

    Raises
    ------
    DamagedFileError
        It is not whole, or its checksum does not fit.
    """
    try:
        document = json.loads(path.read_bytes())
        if sealed and _digest(document["content"]) != document["sha256"]:
            raise ValueError("its checksum does not fit")
    except (ValueError, TypeError, KeyError) as error:
        raise DamagedFileError(
            f"{path}: not a whole JSON document ({error}); delete it and run the command again"
        ) from error
    return document["content"] if sealed else document


def _dump(content: Any) -> str:
    text = json.dumps(content, indent=2, sort_keys=True, ensure_ascii=False, allow_nan=False)
    return text + "\n"


def _digest(content: Any) -> str:
    # As it is read again: keys that are numbers become texts, and sorted as such.
    return sha256(_dump(json.loads(_dump(content))).encode()).hexdigest()


def write_arrays(path: Path, arrays: Mapping[str, ArrayLike]) -> None:
    """Write named arrays as an uncompressed ``.npz``, atomically and without pickles.

    Raises
    ------
    ValueError
        An array holds Python objects.
    """
    import numpy as np

    with atomic(path) as stream, zipfile.ZipFile(stream, "w") as archive:
        for name, array in arrays.items():
            # Of numpy.savez, some versions take a word about pickles for one more array.
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(array), allow_pickle=False)
