"""Databases: shapes with classes, and the protocols they are split by."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from numpy.typing import NDArray

from gipkg.api.plugin import Plugin

if TYPE_CHECKING:
    import trimesh

Axis = Literal["x", "y", "z"]
Part = Literal["train", "test"]


@dataclass(frozen=True, slots=True)
class Shape:
    """An entry of a database: its identifier (unique, stable) and its class."""

    id: str
    label: str
    part: Part | None = None
    """Where it is in the official split, if the database has one."""


@dataclass(frozen=True, slots=True)
class Volume:
    """A solid given voxel by voxel.

    Attributes
    ----------
    values : (X, Y, Z) array
        Numbers or truth values.
    level : float
        What is greater is solid.
    spacing : float
        Distance of neighbouring voxels.
    origin : (3,) tuple
        Place of voxel (0, 0, 0).
    """

    values: NDArray[Any]
    level: float = 0.5
    spacing: float = 1.0
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Protocol:
    """Which shapes of a database take part, and how they are split into training and test part.

    Attributes
    ----------
    train_per_class : int or float or "official"
        So many shapes of every class train, drawn at random, and the others test; a fraction
        between 0 and 1, such as 0.5, is a share of the class, rounded down. ``"official"`` is
        the split that the database is published with (:attr:`Shape.part`): all seeds have the
        same one, and differ in what is learned alone.
    classes : sequence of str, optional
        The classes that take part; by default all.
    shapes_per_class : int, optional
        How many shapes of each of them take part, chosen once for all seeds; by default all.
    """

    train_per_class: int | float | Literal["official"]
    classes: Sequence[str] | None = None
    shapes_per_class: int | None = None


@dataclass(frozen=True, slots=True)
class DatasetTags:
    """Where a database comes from and what it holds."""

    generated: bool
    """Made by gipkg itself; never shown under a real database's name."""
    shapes: int | None
    classes: int | None
    """How many there are with the default parameters; None where that is the user's choice."""
    licence: str
    source: str
    """Address of the files, or how they are generated."""
    files: Mapping[str, str] = field(default_factory=dict)
    """Path under the data root -> SHA-256 of every file that is needed."""
    excluded: Mapping[str, str] = field(default_factory=dict)
    """Identifier -> why it is left out, of what is in the files and is not listed as a shape."""


class Dataset(Plugin):
    """Name to shapes with classes, and the protocols they are split by.

    A database of rigid shapes that all stand upright overrides :attr:`upright`.
    """

    tags: ClassVar[DatasetTags]
    protocols: ClassVar[Mapping[str, Protocol]]
    """Name of the row in the paper's table (``SHREC1``) -> what takes part and how it is split.
    There is none where the shapes are not classified, but mapped."""

    @property
    def upright(self) -> Axis | None:
        """Axis that points up in every shape; None, the default, where nothing does."""
        return None

    def stamp(self, root: Path) -> str:
        """Return what changes when the files do; nothing where they have known checksums."""
        return ""

    @abstractmethod
    def available(self, root: Path) -> bool:
        """Whether `load` works with what lies under the data root; touches no network."""

    @abstractmethod
    def fetch(self, root: Path) -> None:
        """Download and verify what is missing, into `root`.

        Raises
        ------
        DatasetNotFound
            It cannot be had; the message names the address and the folder to put it in.
        """

    @abstractmethod
    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All shapes, sorted by id, the same in every listing."""

    @abstractmethod
    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh | Volume:
        """Read one shape as it is in the database: a mesh, unrepaired, or a volume.

        Raises
        ------
        DatasetNotFound
            The files are not there, or no shape has that identifier.
        MeshFormatError
            The shape's file cannot be read.
        DamagedFileError
            A file that was downloaded is no longer whole.
        """
