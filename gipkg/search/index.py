"""The signatures of a folder of meshes, in one file that is whole at any moment."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from gipkg.errors import (
    DamagedFileError,
    MeshFormatError,
    ParametrizationError,
    UnsupportedMesh,
)
from gipkg.files import sha256_of, write_arrays
from gipkg.formats import MESH_SUFFIXES
from gipkg.formats.arrays import read_arrays
from gipkg.search.network import Signature, SignatureNetwork


@dataclass(frozen=True, slots=True)
class Hit:
    """A shape that was found.

    Attributes
    ----------
    name : str
        Path within the folder, with slashes.
    distance : float
        L2 distance of the signatures.
    label : str
        The class that the network takes it for.
    """

    name: str
    distance: float
    label: str


@dataclass(frozen=True, slots=True)
class Entry:
    """A mesh of the folder: the SHA-256 of its file, and its signature or why it has none."""

    digest: str
    outcome: Signature | str


class _Header(BaseModel):
    model_config = ConfigDict(extra="forbid")

    key: str
    folder: str
    names: list[str]
    digests: list[str]
    labels: list[str]
    failures: dict[str, tuple[str, str]]


@dataclass
class Index:
    """Signatures by name, with the network that made them.

    Attributes
    ----------
    key : str
        Of the network; see :class:`~gipkg.search.network.SignatureNetwork`.
    network : bytes
        Its file.
    folder : str
        Where the meshes are, seen from the folder of the index.
    entries : dict
        Name -> entry. A name is the path within the folder, with slashes.
    """

    key: str
    network: bytes
    folder: str = "."
    entries: dict[str, Entry] = field(default_factory=dict)

    def write(self, path: Path) -> None:
        """Write the index, atomically and without pickles; equal indices, equal bytes."""
        good = dict(sorted(self._signatures()))
        bad = {name: entry for name, entry in sorted(self.entries.items()) if name not in good}
        header = _Header(
            key=self.key,
            folder=self.folder,
            names=list(good),
            digests=[self.entries[name].digest for name in good],
            labels=[signature.label for signature in good.values()],
            failures={name: (entry.digest, str(entry.outcome)) for name, entry in bad.items()},
        )
        embeddings = [signature.embedding for signature in good.values()]
        arrays = {
            "header": np.array(json.dumps(header.model_dump())),
            "signatures": np.array(embeddings, np.float32).reshape(len(good), -1 if good else 0),
            "network": np.frombuffer(self.network, np.uint8),
        }
        write_arrays(path, arrays)

    @classmethod
    def read(cls, path: Path) -> Index:
        """Read what :meth:`write` wrote; nothing in it is executed.

        Raises
        ------
        DamagedFileError
            There is no such file, or it is no whole index.
        """
        if not path.is_file():
            raise DamagedFileError(f"{path}: there is no such file; gipkg index makes one")
        try:
            arrays = read_arrays(path)
            header = _Header.model_validate_json(str(arrays["header"]))
            signatures = arrays["signatures"].astype(np.float32)
            columns = (header.names, header.digests, header.labels, signatures)
            entries = {
                name: Entry(digest, Signature(signature, label))
                for name, digest, label, signature in zip(*columns, strict=True)
            }
            network = arrays["network"].astype(np.uint8).tobytes()
        except (ValueError, KeyError) as error:  # A ValidationError is a ValueError.
            raise DamagedFileError(
                f"{path}: not a whole index; delete it and run gipkg index again"
            ) from error
        if outside := [name for name in (*entries, *header.failures) if not _is_inside(name)]:
            raise DamagedFileError(f"{path}: {outside[0]!r} is outside of the folder; delete it")
        failures = {name: Entry(*entry) for name, entry in header.failures.items()}
        return cls(header.key, network, header.folder, entries | failures)

    def update(self, name: str, path: Path, network: SignatureNetwork) -> Signature:
        """Enter a mesh, unless its file is the one that is known under that name.

        Parameters
        ----------
        name : str
        path : Path
            Its file.
        network : SignatureNetwork
            With the key of this index.

        Returns
        -------
        Signature

        Raises
        ------
        GipkgError
            The mesh cannot be mapped; that is kept too, and said again until the file changes.
        """
        digest = sha256_of(path)
        entry = self.entries.get(name)
        if entry is None or entry.digest != digest:
            entry = Entry(digest, _outcome(path, network))
            self.entries[name] = entry
        if isinstance(entry.outcome, str):
            raise UnsupportedMesh(entry.outcome)
        return entry.outcome

    def nearest(self, embedding: NDArray[np.float32], count: int) -> list[Hit]:
        """Return the nearest shapes, the nearest first; of equal ones, by name.

        Parameters
        ----------
        embedding : (d,) float32 array
        count : int
            How many at most.
        """
        known = dict(sorted(self._signatures()))
        if not known:
            return []
        table = np.array([one.embedding for one in known.values()], np.float64)
        distances = np.linalg.norm(table - embedding.astype(np.float64), axis=1)
        names = list(known)
        chosen = np.argsort(distances, kind="stable")[:count]
        return [Hit(names[i], float(distances[i]), known[names[i]].label) for i in chosen]

    def _signatures(self) -> Iterator[tuple[str, Signature]]:
        for name, entry in self.entries.items():
            if isinstance(entry.outcome, Signature):
                yield name, entry.outcome


def mesh_files(folder: Path) -> dict[str, Path]:
    """Find the meshes in a folder and below, hidden ones left out: name -> path, sorted."""
    found = {
        path.relative_to(folder).as_posix(): path
        for path in folder.rglob("*")
        if path.suffix.lower() in MESH_SUFFIXES and path.is_file()
    }
    shown = (name for name in found if not any(part.startswith(".") for part in name.split("/")))
    return {name: found[name] for name in sorted(shown)}


def _outcome(path: Path, network: SignatureNetwork) -> Signature | str:
    try:
        return network.signature(path)
    except (MeshFormatError, UnsupportedMesh, ParametrizationError) as error:
        return str(error).removeprefix(f"{path}: ")


def _is_inside(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts
