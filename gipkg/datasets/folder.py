"""A database of one's own: a folder of meshes by class."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from hashlib import sha256
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar

from pydantic import Field

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.api.dataset import Axis, Part
from gipkg.errors import DatasetLayoutError, DatasetNotFound
from gipkg.formats import MESH_SUFFIXES
from gipkg.formats.mesh_reading import read_mesh

if TYPE_CHECKING:
    import trimesh

PARTS: Mapping[str, Part] = MappingProxyType({"train": "train", "test": "test"})
"""Name of a folder inside a class -> part of the official split."""


class Folder(Dataset):
    """Meshes in folders named after their classes: ``<path>/<class>/<name>.off``.

    A class may instead have the folders ``train`` and ``test``, as ModelNet's have; if one class
    does, all do, and the protocol ``official`` is theirs. Meshes are told by their suffixes,
    ``.off``, ``.obj``, ``.ply``, ``.stl`` and ``.glb``; other files, and names that begin with a
    dot, are left alone. An identifier is class and name, such as ``mugs-tall_one``; what is
    neither letter nor digit nor one of ``. _ -`` becomes an underscore.
    """

    summary: ClassVar[str] = "A folder of meshes by class: a database of one's own"
    citation: ClassVar[str] = "whoever made the meshes"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=None,
        classes=None,
        licence="the user's own",
        source="a folder on this machine",
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"Own": Protocol(0.5)}

    path: Path = Field(
        Path("meshes"), description="The folder; a relative path counts from the working directory."
    )
    up: Axis | None = Field(
        None, description="Axis that points up in every shape; none if shapes turn in any way."
    )

    @property
    def upright(self) -> Axis | None:
        """Axis that points up in every shape, as the parameter `up` says."""
        return self.up

    def available(self, root: Path) -> bool:
        """Whether the folder is there."""
        return self.path.is_dir()

    def fetch(self, root: Path) -> None:
        """Say where the meshes belong.

        Raises
        ------
        DatasetNotFound
            The folder is not there.
        """
        if not self.available(root):
            raise DatasetNotFound(
                f"there is no folder {self.path.absolute()}; put meshes there, in a folder for "
                "each class, or name another path"
            )

    def stamp(self, root: Path) -> str:
        """Hash the names, sizes and times of all meshes."""
        digest = sha256()
        for file in _meshes(self.path):
            status = file.stat()
            name = file.relative_to(self.path).as_posix()
            digest.update(f"{name!r} {status.st_size} {status.st_mtime_ns}\n".encode())
        return digest.hexdigest()

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All meshes; the class is the name of the folder.

        Raises
        ------
        DatasetNotFound
            The folder is not there.
        DatasetLayoutError
            It is not laid out as a database; the message names what is at fault.
        """
        self.fetch(root)
        found = _shapes(self.path)
        return tuple(found[shape_id][0] for shape_id in sorted(found))

    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh:
        """Read one mesh as it stands in its file.

        Raises
        ------
        DatasetNotFound
            No shape has that identifier, or the folder is not there.
        DatasetLayoutError
            As :meth:`shapes`.
        MeshFormatError
            The file is not readable as a mesh.
        """
        self.fetch(root)
        found = _shapes(self.path).get(shape_id)
        if found is None:
            raise DatasetNotFound(f"{self.path} has no shape {shape_id!r}")
        return read_mesh(found[1])


def _shapes(path: Path) -> dict[str, tuple[Shape, Path]]:
    """Find the shape and the file of every identifier."""
    found: dict[str, tuple[Shape, Path]] = {}
    for file in _meshes(path):
        label, *part = file.relative_to(path).parts[:-1] or ("",)
        if not label or len(part) > 1 or (part and part[0] not in PARTS):
            raise DatasetLayoutError(
                f"{file}: a mesh lies in the folder of its class, or there in train or test"
            )
        shape_id = f"{_safe(label)}-{_safe(file.stem)}"
        if shape_id in found:
            raise DatasetLayoutError(
                f"{found[shape_id][1]} and {file} are both named {shape_id!r}; rename one"
            )
        shape = Shape(shape_id, _safe(label), PARTS[part[0]] if part else None)
        found[shape_id] = shape, file
    _check_classes(path, [shape for shape, _ in found.values()])
    return found


def _check_classes(path: Path, shapes: list[Shape]) -> None:
    full = {shape.label for shape in shapes}
    folders = sorted(one.name for one in path.iterdir() if one.is_dir() and _is_seen(one))
    if empty := [name for name in folders if _safe(name) not in full]:
        raise DatasetLayoutError(
            f"{path}: no mesh ({', '.join(MESH_SUFFIXES)}) is in the folder of the class "
            f"{', '.join(empty)}; put some there or remove it"
        )
    if len(full) < len(folders):
        raise DatasetLayoutError(f"{path}: two of the classes {', '.join(folders)} have one name")
    if len(full) < 2:
        raise DatasetLayoutError(
            f"{path}: two classes or more are told apart, here is {len(full)}; make a folder for "
            "each, with its meshes in it"
        )
    parted = {shape.part is not None for shape in shapes}
    if len(parted) > 1:
        loose = min(shape.id for shape in shapes if shape.part is None)
        raise DatasetLayoutError(
            f"{path}: some meshes are in train or test and others, such as {loose!r}, are not; "
            "divide all classes or none"
        )


def _meshes(path: Path) -> Iterator[Path]:
    """Walk over all meshes in and below a folder, in one order; nothing hidden is entered."""
    if not path.is_dir():
        return
    for entry in sorted(path.iterdir()):
        if _is_seen(entry):
            if entry.is_dir():
                yield from _meshes(entry)
            elif entry.suffix.lower() in MESH_SUFFIXES:
                yield entry


def _is_seen(entry: Path) -> bool:
    return not entry.name.startswith((".", "__MACOSX"))


def _safe(name: str) -> str:
    """Replace what is neither letter, digit, dot, underscore nor hyphen; é has one spelling."""
    return re.sub(r"[^\w.-]+", "_", unicodedata.normalize("NFC", name))
