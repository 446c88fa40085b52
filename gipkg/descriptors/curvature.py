"""Curvature of a surface, averaged over as much of it as heat reaches in a short time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from pydantic import Field
from scipy.sparse.linalg import splu

from gipkg.api import Descriptor, DescriptorTags
from gipkg.descriptors.curvature_measures import curvature_measures

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators

CHANNELS = {
    "principal": ("principal-curvature-1", "principal-curvature-2"),
    "mean": ("mean-curvature",),
    "gaussian": ("gaussian-curvature",),
}


class Curvature(Descriptor):
    """Principal, mean or Gaussian curvature, on the surface scaled to unit area.

    Positive where the surface is convex, its faces being oriented outwards: on the sphere of
    unit area both principal curvatures are √4π.

    A mesh has its curvature on edges and in vertices, as measures: dihedral angles times edge
    lengths, and angle defects. Their densities at a point are averages, here over the reach of
    heat. The isotropic part (mean curvature), the anisotropic part (a tangent direction, carried
    along edges by parallel transport) and the angle defects are diffused each by itself, so that
    averaging costs no curvature on a sphere and the integral of the Gaussian curvature stays 4π.
    """

    summary: ClassVar[str] = "Principal, mean or Gaussian curvature, averaged by diffusion"
    citation: ClassVar[str] = (
        "D. Cohen-Steiner, J.-M. Morvan: Restricted Delaunay Triangulations and Normal Cycle. "
        "Symposium on Computational Geometry, 2003"
    )
    tags: ClassVar[DescriptorTags] = DescriptorTags(rigid_invariant=True, scale_invariant=True)

    quantity: Literal["principal", "mean", "gaussian"] = Field(
        "principal", description="Both principal curvatures, the larger first, or one of the others"
    )
    time: float = Field(
        5e-4,
        gt=0,
        le=1,
        description="Time of the diffusion in units of the surface area; it reaches over about 4π "
        "times that share of the surface",
    )
    logarithm: bool = Field(
        True, description="sign(x) log(1 + |x|) of the curvature x; false gives it as it is"
    )

    def channels(self) -> tuple[str, ...]:
        """Names of the channels, ``log-`` in front where they are logarithmic."""
        prefix = "log-" if self.logarithm else ""
        return tuple(prefix + name for name in CHANNELS[self.quantity])

    def describe(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Diffuse the measures of `mesh`; (V, 2) or (V, 1).

        Raises
        ------
        UnsupportedMesh
            The mesh is not closed, or its faces are not oriented alike.
        """
        measures = curvature_measures(mesh)
        unit = operators.mass.sum()
        if self.quantity == "gaussian":
            density = self._diffuse(measures.gaussian, operators.laplacian, operators)
            values = unit * density[:, None]
        else:
            values = self._diffuse(measures.mean, operators.laplacian, operators)[:, None]
            if self.quantity == "principal":
                turning = measures.turning_laplacian(operators.laplacian)
                difference = self._diffuse(measures.anisotropic, turning, operators)
                values = values + np.abs(difference)[:, None] * [1, -1]
            values *= np.sqrt(unit)
        return np.sign(values) * np.log1p(np.abs(values)) if self.logarithm else values

    def _diffuse(
        self, measure: NDArray[Any], laplacian: sp.csr_array, operators: Operators
    ) -> NDArray[Any]:
        """Return the density (V,) of a measure (V,) after two implicit steps of half the time."""
        step = self.time * operators.mass.sum() / 2
        solver = splu((sp.diags_array(operators.mass) + step * laplacian).tocsc())
        density: NDArray[Any] = solver.solve(operators.mass * solver.solve(measure))
        return density
