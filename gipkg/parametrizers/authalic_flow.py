"""The paper's own flow: area distortion evened out along the gradient of a potential."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Callback, Iteration, Parametrizer, ParametrizerTags
from gipkg.parametrizers.flow.starts import Start, start_map
from gipkg.surfaces.validation import check_genus_zero


class AuthalicFlow(Parametrizer):
    """Flow of the vertices down the area distortion δh = A_s / A - 1 (paper, Section 3).

    Every iteration solves L g = b on the mesh, averages the gradient of g over the faces around
    every vertex by angle, displaces the vertices by ρ ∇g on the mesh, and carries the displaced
    vertices over to the sphere barycentrically (equations 2 to 5). A_s and A are the areas of a
    vertex on the sphere and on the mesh, a third of its faces', the mesh scaled to area 4π.

    Where the paper leaves things open or does not work as printed, the defaults do this:

    * L is positive semidefinite: with ∇² itself, which is negative, the flow would run away from
      equal areas. The right-hand side is A_s - A, the integral of δh that goes with a matrix of
      integrals. Then ρ = 1 is one unit of the flow's time, and the mean square of δh falls along
      the smooth flow, from any start: its rate of change is minus the mean of δh² (δh + 2).
    * The vertices move one after the other, and each halves its step until the distortion of the
      faces around it falls without a flip. `guard` off moves all at once, by the full step.

    The guarantee is that of `guard`: without it, faces flip, and the map is returned as it is.
    With it, on limbs of few vertices and among poor triangles, vertices come to stand where no
    step helps their own star: the flow ends early there, the nearer to equal areas the nearer it
    began, and equal areas are not promised.
    The paper's literal method is ``step=0.01, right_hand_side="ratio", rank=300, guard=False``.
    Its right-hand side makes a step V / 4π times as long on V vertices of equal area: it does well
    on a few hundred vertices, and overshoots and flips faces on some thousands.
    """

    summary: ClassVar[str] = "the paper's iteration: potential, gradient, barycentric transfer"
    citation: ClassVar[str] = (
        "Sinha, Bai & Ramani, Deep Learning 3D Shape Surfaces Using Geometry Images, ECCV 2016"
    )
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(
        guarantees=frozenset({"bijective"}), iterative=True
    )

    iterations: int = Field(100, ge=0, le=10_000, description="iterations at most")
    start: Start = Field("hierarchy", description="map that the flow starts from")
    step: float = Field(
        1.0, gt=0, description="ρ of equation 5, tried first; 0.01 in the paper, without a scale"
    )
    right_hand_side: Literal["integrated", "ratio"] = Field(
        "integrated",
        description="of equation 3: area differences A_s - A, or the bare ratios δh as printed",
    )
    rank: int | None = Field(
        None,
        ge=1,
        description="of the Laplacian's pseudo-inverse, about 300 in the paper; exact if not set",
    )
    guard: bool = Field(
        True, description="shorten steps where a face would flip or distortion grow"
    )

    def parametrize(
        self, mesh: trimesh.Trimesh, callback: Callback | None = None
    ) -> NDArray[np.float64]:
        """Map a closed genus-0 mesh to the sphere (see :class:`~gipkg.api.Parametrizer`)."""
        from gipkg.parametrizers.flow.authalic import AreaFlow
        from gipkg.parametrizers.sphere.areas import mean_square_distortion
        from gipkg.parametrizers.sphere.bijectivity import require_bijective

        check_genus_zero(mesh)
        faces = np.asarray(mesh.faces, np.int64)
        flow = AreaFlow(np.asarray(mesh.vertices, np.float64), faces, self.rank)
        sphere = start_map(mesh, self.start)

        def tell(number: int, step: float) -> None:
            if callback:
                objective = mean_square_distortion(sphere, faces, flow.elements.areas)
                callback(Iteration(number, sphere, objective, step))

        tell(0, 0.0)
        for number in range(1, self.iterations + 1):
            sphere, moved = flow.advance(
                sphere,
                step=self.step,
                integrated=self.right_hand_side == "integrated",
                guard=self.guard,
            )
            if not moved:
                break
            tell(number, moved)
        if self.guard:
            require_bijective(sphere, faces, "choose another start of the flow")
        return sphere
