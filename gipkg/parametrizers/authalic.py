"""The authalic map: areas kept, angles as far as that leaves room (paper, Section 3)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags


class Authalic(Parametrizer):
    """Bijective spherical map of least area distortion.

    It minimises the squared logarithms of the area ratios plus `shape_weight` times a conformal
    term, from a bijective start, by Gauss-Newton steps that never flip a face. The paper
    reduces the same area distortion by a flow of small explicit steps.

    The defaults are for learning: fast, areas of faces to a few percent. For the most exact areas
    take ``shape_weight=1e-7, rounds=150, trials=3, exact_areas=True``; the rounds begin at a smooth
    map and weigh faces half alike and half by their squared areas, as the two measures of
    distortion do. Vertex areas can then be exact, since there are V of them and 2V - 3 degrees of
    freedom. The 2V - 5 face areas take up all freedom and block each other: rounds bring them
    within some thousandths, more slowly the closer they are.
    """

    summary: ClassVar[str] = "area-preserving, bijective (the paper's map, found variationally)"
    citation: ClassVar[str] = (
        "Sinha, Bai & Ramani, Deep Learning 3D Shape Surfaces Using Geometry Images, ECCV 2016; "
        "start after Praun & Hoppe, Spherical Parametrization and Remeshing, SIGGRAPH 2003"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(
        guarantees=frozenset({"bijective", "area"}), iterative=True
    )

    shape_weight: float = Field(
        1e-3,
        ge=0,
        le=1,
        description="weight of angles against areas; 0 keeps areas alone",
    )
    max_iterations: int = Field(100, ge=1, le=10_000, description="Gauss-Newton steps at most")
    tolerance: float = Field(
        1e-3, ge=0, lt=1, description="stop when a step lowers the energy by less than this share"
    )
    rounds: int = Field(
        0,
        ge=0,
        le=1000,
        description="rounds, of two dozen factorizations each, that bring face areas nearer to "
        "exact ones; beyond 2,000 vertices fewer in proportion, at least a tenth",
    )
    face_tolerance: float = Field(
        1e-3,
        ge=0,
        lt=1,
        description="end the rounds at this standard deviation of the faces' area ratios",
    )
    trials: int = Field(
        1,
        ge=1,
        le=5,
        description="how often the rounds are taken, each time with other pushes, while more than "
        "four times the face tolerance is left",
    )
    exact_areas: bool = Field(
        False,
        description="end on exact areas of all vertices",
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.variational.optimal_map import least_distorted_map

        return least_distorted_map(
            mesh,
            area_weight=1.0,
            shape_weight=self.shape_weight,
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            rounds=self.rounds,
            face_tolerance=self.face_tolerance,
            trials=self.trials,
            callback=callback,
            exact_areas=self.exact_areas,
        )
