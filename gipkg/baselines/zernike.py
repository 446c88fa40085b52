"""3D Zernike descriptors of the solid inside a closed mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import BaselineTags
from gipkg.baselines.corners import in_unit_ball
from gipkg.baselines.solids import about_volume_centroid
from gipkg.baselines.vectors import VectorBaseline
from gipkg.baselines.zernike_moments import zernike_moments

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators


class Zernike(VectorBaseline):
    """Norms of the 3D Zernike moments of the filled volume over each (n, l).

    The solid is centred at its centroid and scaled so that its farthest vertex lies on the unit
    sphere. Moments are integrals over the polyhedron itself; there is no voxel grid. Where the
    surface crosses itself, volume counts as often as it is enclosed.
    """

    summary: ClassVar[str] = "Rotation-invariant 3D Zernike moments of the filled volume"
    citation: ClassVar[str] = (
        "M. Novotni, R. Klein: Shape retrieval using 3D Zernike descriptors. "
        "Computer-Aided Design 36(11), 2004"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    order: int = Field(20, ge=1, le=24, description="Highest order n; 20 gives 121 invariants")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Integrate over the solid; (D,) ordered by n, then l; `operators` are not used.

        Raises
        ------
        UnsupportedMesh
            The mesh encloses no positive volume.
        """
        corners = in_unit_ball(about_volume_centroid(mesh))
        moments = zernike_moments(corners, self.order)
        return np.array([np.linalg.norm(moments[key]) for key in sorted(moments)])
