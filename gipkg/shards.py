"""Shards: files that hold the arrays of many shapes, and the map that fills them.

A database is cut into shards by a hash of the shapes' identifiers, so that adding a shape
changes one shard only. A shard is an ``.npz`` with one member ``<quoted id>/<name>`` for every
array and one, ``failures``, with the shapes that have none and why, as JSON. Identifiers are
data: they are quoted, and no file on the disk is named after one.
"""

from __future__ import annotations

import json
import logging
import shutil
import time
import zipfile
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from types import MappingProxyType
from typing import Any
from urllib.parse import quote, unquote

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import DamagedFileError
from gipkg.files import atomic, sha256_of, write_arrays, write_csv, write_text
from gipkg.formats.arrays import array_names, read_arrays
from gipkg.progress import progress
from gipkg.zip_damage import naming_damage, require_whole_directory

Arrays = Mapping[str, NDArray[Any]]
"""What is known of one shape: a name for every array."""

NO_FAILURES: Mapping[str, str] = MappingProxyType({})

_FAILURES = "failures"
_NOT_THE_SHAPES_FAULT = (OSError, MemoryError, ImportError, DamagedFileError)
"""Faults of the machine or the installation: they end the job, a rerun takes it up again."""
_DAMAGE = ("not a whole shard", "run the command again")
"""What is said of a damaged file, and the way out."""

log = logging.getLogger(__name__)


def shard_of(shape_id: str, count: int) -> int:
    """Return the number, below `count`, of the shard a shape is in, whatever else there is."""
    return int.from_bytes(sha256(shape_id.encode()).digest()[:8]) % count


def content_key(parameters: Any, inputs: Iterable[Path] = ()) -> str:
    """Hash what a computation depends on: JSON-able parameters and the bytes of its inputs.

    Returns
    -------
    str
        64 hexadecimal digits; equal keys mean that unfinished work can be taken up.
    """
    digest = sha256(json.dumps(parameters, sort_keys=True).encode())
    for path in inputs:
        digest.update(bytes.fromhex(sha256_of(path)))
    return digest.hexdigest()


class Shard(Mapping[str, dict[str, NDArray[Any]]]):
    """A shard file, read shape by shape: a mapping from identifier to its arrays.

    Attributes
    ----------
    path : Path
    ids : tuple of str
        The shapes that have arrays, sorted.
    failures : dict
        Identifier -> reason, of the shapes that have none.
    """

    def __init__(
        self, path: Path, members: Mapping[str, tuple[str, ...]], failures: dict[str, str]
    ) -> None:
        self.path = path
        self.ids = tuple(members)
        self.failures = failures
        self._members = members

    @classmethod
    def open(cls, path: Path) -> Shard:
        """Read the list of a shard's shapes, not yet their arrays.

        Raises
        ------
        DamagedFileError
            The file is not a whole shard.
        """
        with naming_damage(path, *_DAMAGE):
            require_whole_directory(path)
            failures = json.loads(str(read_arrays(path, [_FAILURES])[_FAILURES]))
            members: dict[str, tuple[str, ...]] = {}
            for key in array_names(path):
                shape, slash, name = key.partition("/")
                if slash:
                    members[unquote(shape)] = (*members.get(unquote(shape), ()), name)
        return cls(path, dict(sorted(members.items())), failures)

    def __getitem__(self, shape_id: str) -> dict[str, NDArray[Any]]:
        """Read the arrays of one shape.

        Raises
        ------
        KeyError
            The shape is not in this shard, or failed.
        DamagedFileError
            They are not in the file any more, or a checksum does not fit.
        """
        names = {f"{_quote(shape_id)}/{name}": name for name in self._members[shape_id]}
        with naming_damage(self.path, *_DAMAGE):
            arrays = read_arrays(self.path, names)
        return {unquote(names[key]): array for key, array in arrays.items()}

    def __iter__(self) -> Iterator[str]:
        return iter(self.ids)

    def __len__(self) -> int:
        return len(self.ids)


def map_shard(
    ids: Collection[str],
    compute: Callable[[str], Arrays],
    out: Path,
    work: Path,
    label: str,
    *,
    key: str,
    failures: Mapping[str, str] = NO_FAILURES,
    seconds: Path | None = None,
) -> None:
    """Compute the arrays of every shape and pack them into one file.

    Each result is kept under ``<work>/<key>`` as soon as it is there: a job that is killed
    and started again goes on with the shapes it had not done. The file appears at the end, at
    once, and the folder `work` goes. The same arrays give the same bytes.

    Parameters
    ----------
    ids : collection of str
        The shapes to compute, unique.
    compute : callable
        Identifier -> one or more named arrays. Where it raises, the shape is recorded as
        failed and the others go on.
    out : Path
        The shard file.
    work : Path
        Folder of this shard's unfinished work, used by no other shard.
    label : str
        What is done, for the progress display.
    key : str
        From :func:`content_key`; work of another key is never used.
    failures : mapping
        Shapes that failed in an earlier stage and why: carried on.
    seconds : Path, optional
        Table of the CPU seconds that each of the shapes took, in whichever run it was done.
        A clock never says the same twice, so this is a file of its own.
    """
    folder = work / key
    failed = dict(failures)
    done: dict[str, Path] = {}
    for shape_id in progress(sorted(ids), label):
        part = folder / f"{sha256(shape_id.encode()).hexdigest()}.npz"
        try:
            if not part.exists():
                began = time.process_time()
                arrays = compute(shape_id)
                if seconds is not None:
                    write_text(_clock(part), f"{time.process_time() - began:.6f}")
                _keep(part, arrays)
        except _NOT_THE_SHAPES_FAULT:
            raise
        except Exception as error:
            failed[shape_id] = f"{type(error).__name__}: {error}"
            log.exception("%s: %s failed", label, shape_id)
        else:
            done[shape_id] = part
    if seconds is not None:
        taken = [(shape_id, _clock(part).read_text()) for shape_id, part in done.items()]
        write_csv(seconds, ("id", "seconds"), taken, sealed=True)
    _pack(out, done, failed)
    with suppress(FileNotFoundError):
        shutil.rmtree(work)


def join(*shards: Shard) -> tuple[tuple[str, ...], dict[str, str]]:
    """Return the shapes that all of the shards have, sorted, and the failures of any."""
    shared = set.intersection(*(set(shard.ids) for shard in shards))
    failures = {
        shape_id: reason
        for shard in reversed(shards)
        for shape_id, reason in shard.failures.items()
    }
    return tuple(sorted(shared)), failures


def _keep(part: Path, arrays: Arrays) -> None:
    if not arrays:
        raise ValueError("nothing was computed")
    write_arrays(part, {_quote(name): array for name, array in arrays.items()})


def _clock(part: Path) -> Path:
    """Return the file beside a part that says what it took; it is written before the part."""
    return part.with_suffix(".seconds")


def _pack(out: Path, done: Mapping[str, Path], failures: Mapping[str, str]) -> None:
    """Copy the members of the parts, never more than a buffer in memory."""
    with atomic(out) as stream, zipfile.ZipFile(stream, "w") as archive:
        with archive.open(f"{_FAILURES}.npy", "w", force_zip64=True) as target:
            np.lib.format.write_array(
                target, np.array(json.dumps(failures, sort_keys=True)), allow_pickle=False
            )
        for shape_id, part in done.items():
            with naming_damage(part, *_DAMAGE), zipfile.ZipFile(part) as source:
                require_whole_directory(part)
                for name in sorted(source.namelist()):
                    member = f"{_quote(shape_id)}/{name}"
                    with (
                        source.open(name) as content,
                        archive.open(member, "w", force_zip64=True) as target,
                    ):
                        shutil.copyfileobj(content, target, 1 << 20)


def _quote(text: str) -> str:
    """Quote a name so that it is one harmless component of a path: no slash, no dot."""
    return quote(text, safe="").replace(".", "%2E")
