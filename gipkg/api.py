"""The contracts of a plugin: the one file to read before writing one.

A plugin is a small frozen pydantic model. Its fields are its parameters: typed, each with
a default and a ``description`` (and bounds where they exist). It has one method to call and
is pure: arrays in, arrays out; files, configuration and clocks belong to the workflow.
Only a :class:`Dataset` reads files, and only under the data root it is given.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from gipkg.errors import BrokenPluginError

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction

API_VERSION = 1
"""Version of these contracts; it changes when an existing plugin would have to change."""


class Plugin(BaseModel, ABC):
    """Base of all kinds: parameters as fields, metadata as class variables."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    summary: ClassVar[str]
    """One line for listings and tables."""
    citation: ClassVar[str]
    """The publication the method comes from, as author, title, venue and year."""

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        for name, info in cls.model_fields.items():
            if info.is_required():
                raise BrokenPluginError(f"{cls.__name__}.{name} needs a default value")
            if not info.description:
                raise BrokenPluginError(
                    f"{cls.__name__}.{name} needs a help text: Field(..., description='…')"
                )


@dataclass(frozen=True, slots=True)
class SphericalMap:
    """A mesh and the image of its vertices on the unit sphere.

    Attributes
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices and F faces.
    sphere : (V, 3) float64 array
        Unit vectors, in the vertex order of `mesh`.
    """

    mesh: trimesh.Trimesh
    sphere: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Iteration:
    """What an iterative parametrizer tells its callback.

    Attributes
    ----------
    number : int
        0 for the start, then one more each time.
    sphere : (V, 3) float64 array
        The map reached; copy it to keep it.
    objective : float
        What the method lowers, in its own units.
    step : float
        Length of the step that led here, as a fraction of the step proposed; 0 at the start.
    """

    number: int
    sphere: NDArray[np.float64]
    objective: float
    step: float


Callback = Callable[[Iteration], None]
"""Called at the start and after every iteration of a parametrizer."""


@dataclass(frozen=True, slots=True)
class ParametrizerTags:
    """What a parametrizer promises; the conformance suite checks what is promised."""

    guarantees: frozenset[Literal["bijective", "area", "angle"]] = frozenset()
    deterministic: bool = True
    iterative: bool = False
    """Calls its callback; the others ignore it."""


class Parametrizer(Plugin):
    """Closed genus-0 mesh to unit sphere."""

    tags: ClassVar[ParametrizerTags] = ParametrizerTags()

    @abstractmethod
    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map the vertices of a closed, oriented genus-0 mesh to the unit sphere.

        Parameters
        ----------
        mesh : trimesh.Trimesh
            V vertices; never changed.
        callback : callable, optional
            Told every iteration by a method tagged ``iterative``; an exception of it ends the
            work and is passed on.

        Returns
        -------
        (V, 3) float64 array
            Unit vectors in the mesh's vertex order.

        Raises
        ------
        UnsupportedMesh
            The mesh is not closed, oriented, of one component and of genus 0.
        ParametrizationError
            A guarantee named in ``tags`` could not be kept.
        """


@dataclass(frozen=True, slots=True)
class DescriptorTags:
    """How a descriptor behaves under changes of the surface."""

    intrinsic: bool = False
    """Unchanged by isometries, articulation included."""
    rigid_invariant: bool = False
    """Unchanged by rotations and translations."""
    scale_invariant: bool = False


class Descriptor(Plugin):
    """Mesh to per-vertex channels."""

    tags: ClassVar[DescriptorTags] = DescriptorTags()

    @abstractmethod
    def channels(self) -> tuple[str, ...]:
        """Names of the C channels, in order."""

    @abstractmethod
    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Compute the channels at every vertex.

        Parameters
        ----------
        mesh : trimesh.Trimesh
            V vertices; never changed.
        operators : Operators
            Laplacian, mass and eigenpairs of `mesh`, computed at first use and shared.

        Returns
        -------
        (V, C) float64 array
        """


@dataclass(frozen=True, slots=True)
class BaselineTags:
    """What leaves the distance between two shapes as it is."""

    rigid_invariant: bool = False
    """Rotations and translations."""
    scale_invariant: bool = False


class Baseline(Plugin):
    """Mesh to one representation a shape, and the classifier that goes with it.

    Derive from :class:`gipkg.baselines.vectors.VectorBaseline` where a representation is a
    vector: it classifies by a linear support vector machine and retrieves by the L2 distance,
    and only `represent` is left to write.
    """

    tags: ClassVar[BaselineTags] = BaselineTags()

    @abstractmethod
    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[Any]:
        """Represent one closed mesh by itself: a vector, grids, a panorama, a row a vertex.

        Parameters
        ----------
        mesh : trimesh.Trimesh
            V vertices; never changed.
        operators : Operators
            Laplacian, mass and eigenpairs of `mesh`, computed at first use and shared.

        Returns
        -------
        (N, …) array
            Finite numbers. Type and shape are the same for every mesh, but for N where the rows
            are a set; then their order is of no account to `predict`.
        """

    @abstractmethod
    def predict(
        self,
        representations: Mapping[str, NDArray[Any]],
        train: Mapping[str, str],
        test: Sequence[str],
        *,
        seed: int = 0,
        device: str = "auto",
        checkpoint: Path | None = None,
    ) -> Prediction:
        """Learn from the training part of a split all that is learned, and predict the other.

        The test part chooses nothing: no vocabulary, no scale, no epoch. What is said of a
        test shape depends on no other one.

        Parameters
        ----------
        representations : mapping of shape id to array
            From `represent`, for both parts; reading one may read a file. Never changed.
        train : mapping of shape id to class
            In the order of the split, which may be part of the result.
        test : sequence of shape ids
        seed : int
            Of every random choice; equal arguments give equal bits.
        device : str
            ``auto``, ``cpu``, ``cuda``, …: where networks run.
        checkpoint : Path, optional
            Where a long training may keep its state, to go on from there after it was killed.

        Returns
        -------
        Prediction
            Of the test part.
        """


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
