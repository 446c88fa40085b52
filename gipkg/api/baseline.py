"""Baselines: a representation of a mesh, and the classifier that goes with it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from numpy.typing import NDArray

from gipkg.api.plugin import Plugin

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction


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
