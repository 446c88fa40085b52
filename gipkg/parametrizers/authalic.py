"""The authalic map: areas kept, angles as far as that leaves room (paper, Section 3)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Parametrizer, ParametrizerTags

if TYPE_CHECKING:
    from gipkg.parametrizers.variational.multipliers import Rounds

_SHAPE_WEIGHT, _ROUNDS = 1e-3, 30
"""Weight of angles, at first, and rounds at most, where both are left open."""
_FEW_PUSHES, _SHORT_PUSHES = 3, 10
"""A level on the way to the first round, and steps of each: enough for a few percent."""


class Authalic(Parametrizer):
    """Bijective spherical map of least area distortion.

    It minimises the squared logarithms of the area ratios plus `shape_weight` times a conformal
    term, from a bijective start, by Gauss-Newton steps that never flip a face. The paper
    reduces the same area distortion by a flow of small explicit steps.

    The defaults bring the areas of faces within three percent (one standard deviation): from a
    smooth map areas are pushed toward exact ones, a few times at each weight of angles on the way
    down, and in rounds where that is not enough. With a `shape_weight` of one's own, angles keep
    that weight and a descent is all; so it is with ``rounds=0``, for learning: faster, areas of
    faces to a few percent on most shapes. For the most exact areas take ``shape_weight=1e-7,
    rounds=150, face_tolerance=1e-3, trials=3, exact_areas=True``; faces weigh half alike in the
    rounds and half by their squared areas, as the two measures of distortion do. Vertex areas can
    then be exact, since there are V of them and 2V - 3 degrees of freedom. The 2V - 5 face areas
    take up all freedom and block each other: rounds bring them within some thousandths, more slowly
    the closer they are.
    """

    summary: ClassVar[str] = "area-preserving, bijective (the paper's map, found variationally)"
    citation: ClassVar[str] = (
        "Sinha, Bai & Ramani, Deep Learning 3D Shape Surfaces Using Geometry Images, ECCV 2016; "
        "start after Praun & Hoppe, Spherical Parametrization and Remeshing, SIGGRAPH 2003"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(
        guarantees=frozenset({"bijective", "area"}), iterative=True
    )

    shape_weight: float | None = Field(
        None,
        ge=0,
        le=1,
        description="weight of angles against areas, 0 for areas alone; left open it falls until "
        "areas are within the face tolerance (with 0 rounds it is .001)",
    )
    max_iterations: int = Field(100, ge=1, le=10_000, description="Gauss-Newton steps at most")
    tolerance: float = Field(
        1e-3, ge=0, lt=1, description="stop when a step lowers the energy by less than this share"
    )
    rounds: int | None = Field(
        None,
        ge=0,
        le=1000,
        description="rounds at most, of two dozen factorizations each, that bring face areas "
        "nearer to exact ones; beyond 2,000 vertices fewer in proportion, at least a tenth; left "
        "open 30 with an open weight of angles, else none",
    )
    face_tolerance: float = Field(
        0.03,
        ge=0,
        lt=1,
        description="take no more rounds at this standard deviation of the faces' area ratios",
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
            shape_weight=_SHAPE_WEIGHT if self.shape_weight is None else self.shape_weight,
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            rounds=self._rounds(),
            callback=callback,
            exact_areas=self.exact_areas,
        )

    def _rounds(self) -> Rounds | None:
        """Say what rounds are asked for: short ones, to the tolerance, with an open weight."""
        from gipkg.parametrizers.variational.multipliers import Rounds

        open_weight = self.shape_weight is None
        count = self.rounds
        if count is None:
            count = _ROUNDS if open_weight else 0
        if count == 0:
            return None
        rounds = Rounds(count, self.face_tolerance, shape_falls=open_weight, trials=self.trials)
        if open_weight:
            rounds = replace(rounds, pushes_a_level=_FEW_PUSHES, steps_a_push=_SHORT_PUSHES)
        return rounds
