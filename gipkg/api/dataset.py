"""Databases: shapes with classes, and the protocols they are split by."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from numpy.typing import NDArray

from gipkg.api.plugin import Plugin

if TYPE_CHECKING:
    import trimesh


@dataclass(frozen=True, slots=True)
class Shape:
    """An entry of a database: its identifier (unique, stable) and its class."""

    id: str
    label: str


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
    """Random splits: `train_per_class` shapes of every class train, the others test.

    A fraction between 0 and 1, such as 0.5, is a share of the class, rounded down.
    """

    train_per_class: int | float


@dataclass(frozen=True, slots=True)
class DatasetTags:
    """Where a database comes from and what it holds."""

    generated: bool
    """Made by gipkg itself; never shown under a real database's name."""
    shapes: int
    classes: int
    """How many there are with the default parameters."""
    licence: str
    source: str
    """Address of the files, or how they are generated."""
    files: Mapping[str, str] = field(default_factory=dict)
    """Path under the data root -> SHA-256 of every file that is needed."""


class Dataset(Plugin):
    """Name to shapes with classes, and the protocols they are split by."""

    tags: ClassVar[DatasetTags]
    protocols: ClassVar[Mapping[str, Protocol]]
    """Name of the row in the paper's table (``SHREC1``) -> how it is split. There is none where
    the shapes are not classified, but mapped."""

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
        """Read one shape as it is in the database: a mesh, unrepaired, or a volume."""
