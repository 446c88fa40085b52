"""Energies of spherical harmonics of the distance to a surface, on spheres about its centroid."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field
from scipy.special import roots_legendre

from gipkg.api import BaselineTags
from gipkg.baselines.corners import about_area_centroid
from gipkg.baselines.solid_harmonics import solid_harmonics
from gipkg.baselines.vectors import VectorBaseline

if TYPE_CHECKING:
    import trimesh

    from gipkg.descriptors.operators import Operators

RADIUS = 32
"""Radius of the largest sphere in voxels: half a grid of 64."""
MEAN_DISTANCE = RADIUS / 2
"""To which the surface is scaled: mean distance to its centroid, in voxels."""
VARIANCE = 8.0
"""Of the Gaussian of the distance, in squared voxels."""
NODES = 32
"""Rows of a sphere's grid; its quadrature is exact up to degree 63, harmonic included."""


class SphericalHarmonics(VectorBaseline):
    """Root energies of every band of degrees on every concentric sphere.

    The function is exp(-d² / 16) of the distance d to the surface in voxels, a grid of 64 voxels
    being four times as wide as the mean distance of the surface to its centroid. Its sphere of
    radius r counts with weight r, and the whole function has norm 1.

    Parameters, weights and the Gaussian are those of the first author's program (2013), whose
    vectors of 32 x 17 numbers are the 544 that papers on ModelNet quote. There, bands 0 and 2
    together are a quadratic form, whose three principal values tell more than two energies
    (Section 5 of the paper); without `quadratic` the vector is the plain one, 32 x 16.

    There, too, the surface is rasterised and the distance read off the grid. Here it is the
    distance to the triangles themselves: no voxel, and nothing cut off at the border of a grid.
    Centroid and mean distance are those of the area, where the paper takes the voxels it meets.
    """

    summary: ClassVar[str] = "Spherical harmonics of the distance field: rotation-invariant bands"
    citation: ClassVar[str] = (
        "M. Kazhdan, T. Funkhouser, S. Rusinkiewicz: Rotation Invariant Spherical Harmonic "
        "Representation of 3D Shape Descriptors. Symposium on Geometry Processing, 2003"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    radii: int = Field(32, ge=1, le=64, description="Number of spheres")
    bands: int = Field(16, ge=3, le=NODES, description="Number of degrees, 0 included")
    quadratic: bool = Field(
        True, description="Three principal values in place of the energies of degrees 0 and 2"
    )

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float64]:
        """Measure every sphere; (D,) from the innermost out; `operators` are not used."""
        corners = _normalised(mesh)
        directions, weights, harmonics = _sphere(self.bands)
        radii = RADIUS * (np.arange(self.radii) + 0.5) / self.radii
        squared = _squared_distances(radii[:, None, None] * directions, corners)
        values = radii[:, None] * np.exp(-squared / (2 * VARIANCE))
        values /= np.sqrt((values**2 @ weights).sum())
        energies = np.stack([_energy(values * weights, one) for one in harmonics], axis=1)
        if self.quadratic:
            moments = np.einsum("rq,qi,qj->rij", values * weights, directions, directions)
            energies = np.hstack([principal_values(moments), np.delete(energies, [0, 2], axis=1)])
        return energies.ravel()


def principal_values(moments: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what is invariant of the part of degrees 0 and 2 of a function on the unit sphere.

    That part is a quadratic form with a symmetric matrix M. Of two forms with the same principal
    axes, the distance of their vectors is the L2 distance of the functions.

    Parameters
    ----------
    moments : (N, 3, 3) float64 array
        Means over the sphere of the function times x xᵀ, which are (2 M + tr M) / 15.

    Returns
    -------
    (N, 3) float64 array
        In ascending order; the norm of a row is that of the part, in mean square.
    """
    traces = np.trace(moments, axis1=1, axis2=2)[:, None]
    values = (15 * np.linalg.eigvalsh(moments) - 3 * traces) / 2
    # The mean square of a form with values d is (2 Σd² + (Σd)²) / 15: a square root of that.
    mixed = (np.sqrt(5) - np.sqrt(2)) / 3 * values.sum(axis=1, keepdims=True)
    return (np.sqrt(2) * values + mixed) / np.sqrt(15)


def _normalised(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Return the corners (F, 3, 3) of the faces about the centroid of the surface, scaled.

    By the mean distance, as the original does: other baselines go by the farthest vertex, which
    a thin limb decides alone.
    """
    corners, areas = about_area_centroid(mesh)
    # The rule of edge midpoints: of degree 2, and there are many triangles.
    midpoints = (corners + np.roll(corners, 1, axis=1)) / 2
    distance = areas @ np.linalg.norm(midpoints, axis=2).mean(axis=1) / areas.sum()
    return corners * (MEAN_DISTANCE / distance)


def _squared_distances(
    points: NDArray[np.float64], corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the (R, Q) squared distances of (R, Q, 3) points to (F, 3, 3) triangles."""
    import igl

    faces = np.arange(3 * len(corners), dtype=np.int64).reshape(-1, 3)
    squared, _, _ = igl.point_mesh_squared_distance(
        points.reshape(-1, 3), corners.reshape(-1, 3), faces
    )
    return np.asarray(squared).reshape(points.shape[:2])


@lru_cache(maxsize=1)
def _sphere(
    bands: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[NDArray[np.complex128], ...]]:
    """Return Gauss-Legendre points (Q, 3), their weights (Q,), which sum to 1, and harmonics.

    These are (l + 1, Q), for l = 0, …, bands - 1, of mean square 1.
    """
    heights, weights = roots_legendre(NODES)
    angles = np.pi * np.arange(2 * NODES) / NODES
    across = np.sqrt(1 - heights**2)[:, None]
    directions = np.stack(
        np.broadcast_arrays(across * np.cos(angles), across * np.sin(angles), heights[:, None]),
        axis=2,
    ).reshape(-1, 3)
    weights = np.repeat(weights / weights.sum(), 2 * NODES) / (2 * NODES)
    return directions, weights, tuple(solid_harmonics(directions, bands - 1))


def _energy(
    weighted: NDArray[np.float64], harmonics: NDArray[np.complex128]
) -> NDArray[np.float64]:
    """Return the norms (R,) of one degree of (R, Q) functions times quadrature weights."""
    squares = np.abs(weighted @ harmonics.conj().T) ** 2
    # An order m below 0 has the energy of -m, since the functions are real.
    return np.sqrt(2 * squares.sum(axis=1) - squares[:, 0])
