"""Parametrizers: from a closed genus-0 mesh to the unit sphere."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gipkg.api.plugin import Plugin

if TYPE_CHECKING:
    import trimesh


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
