"""The way shared by the variational parametrizers: check, embed, descend, verify."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Callback
from gipkg.errors import ParametrizationError
from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.exact_areas import project_onto_vertex_areas
from gipkg.parametrizers.variational.newton import minimize
from gipkg.surfaces.validation import check_genus_zero


def least_distorted_map(
    mesh: trimesh.Trimesh,
    *,
    area_weight: float,
    shape_weight: float,
    max_iterations: int,
    tolerance: float,
    exact_areas: bool = False,
    callback: Callback | None = None,
) -> NDArray[np.float64]:
    """Find a bijective spherical map of least area and shape distortion.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented, of genus 0, with V vertices.
    area_weight, shape_weight : float
        Of the two terms of :class:`~gipkg.parametrizers.variational.energy.MapEnergy`.
    max_iterations : int
    tolerance : float
        Relative decrease of the energy that ends the descent.
    exact_areas : bool
        Project the result onto exact vertex areas.
    callback : callable, optional
        Told every iteration of the descent.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors; no face is flipped and the degree is 1.

    Raises
    ------
    UnsupportedMesh
        The mesh is outside the domain.
    ParametrizationError
        The map could not be kept bijective in double precision.
    """
    check_genus_zero(mesh)
    vertices = np.asarray(mesh.vertices, np.float64)
    faces = np.asarray(mesh.faces, np.int64)
    areas, cotangents = triangle_shapes(vertices, faces)
    targets = areas * (4 * np.pi / areas.sum())
    start = embed(vertices, faces, targets)
    # Between uniform weights, with which slivers rule, and areas, with which they are ignored.
    weights = area_weight * np.sqrt(targets * targets.mean())
    energy = MapEnergy(faces, targets, weights, cotangents, shape_weight)
    sphere = minimize(
        energy, start, max_iterations=max_iterations, tolerance=tolerance, callback=callback
    )
    if exact_areas:
        sphere = project_onto_vertex_areas(energy, sphere)
    _verify(sphere, faces)
    return sphere


def triangle_shapes(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Areas (F,) and cotangents of the corners' angles (F, 3)."""
    corners = vertices[faces]
    to_next = np.roll(corners, -1, axis=1) - corners
    to_previous = np.roll(corners, 1, axis=1) - corners
    doubled = np.linalg.norm(np.cross(to_next, to_previous), axis=2)
    return doubled[:, 0] / 2, np.einsum("fkc,fkc->fk", to_next, to_previous) / doubled


def _verify(sphere: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
    """Raise unless the stored coordinates are a bijection, decided exactly."""
    flips = np.count_nonzero(flipped_faces(sphere, faces))
    degree = signed_spherical_areas(sphere, faces).sum() / (4 * np.pi)
    if flips or abs(degree - 1) > 1e-9:
        raise ParametrizationError(
            f"the map has {flips} flipped faces and degree {degree:.6f}: parts of the mesh shrink "
            "below double precision; raise the weight of the area term"
        )
