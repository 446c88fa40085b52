"""The way shared by the variational parametrizers: order, embed, descend, verify."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from gipkg.api import Callback, Iteration
from gipkg.parametrizers.hierarchy.canonical import canonical_order
from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.sphere.bijectivity import require_bijective
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.exact_areas import with_exact_vertex_areas
from gipkg.parametrizers.variational.multipliers import (
    SMOOTH,
    Rounds,
    toward_exact_face_areas,
)
from gipkg.parametrizers.variational.newton import Descent
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.validation import check_genus_zero

_BETWEEN = 0.1
"""Weight of shape between the smooth map and the end of a descent: areas met from a smooth map meet
fewer jams."""
_PATH_ITERATIONS, _PATH_TOLERANCE = 15, 1e-2
_WAY_OUT = (
    "parts of the mesh shrink below double precision; raise the weight of the area term, or "
    "remesh thin parts"
)


def least_distorted_map(
    mesh: trimesh.Trimesh,
    *,
    area_weight: float,
    shape_weight: float,
    max_iterations: int,
    tolerance: float,
    rounds: Rounds | None = None,
    exact_areas: bool = False,
    callback: Callback | None = None,
) -> NDArray[np.float64]:
    """Find a bijective spherical map of least area and shape distortion.

    The mesh enters only through an order of its own and through areas, angles and lengths
    rounded to single precision, so that permuting or moving it gives the same map.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented, of genus 0, with V vertices.
    area_weight, shape_weight : float
        Of the two terms of :class:`~gipkg.parametrizers.variational.energy.MapEnergy`.
    max_iterations : int
        Of the descent, to the smooth map that rounds begin at and from there.
    tolerance : float
        Relative decrease of the energy that ends the descent.
    rounds : Rounds, optional
        In place of the descent from the smooth map on. The two measures of area distortion weigh
        alike in them.
    exact_areas : bool
        End on exact areas of all vertices.
    callback : callable, optional
        Told every iteration.

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
    order, faces = canonical_order(
        np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int64)
    )
    vertices = np.asarray(mesh.vertices, np.float64)[order]
    areas, cotangents = face_areas(vertices, faces), corner_cotangents(vertices, faces)
    energy = _energy(faces, areas, cotangents, area_weight, shape_weight)
    # More threads would add up the blocks of a factorization in another order.
    with threadpool_limits(limits=1):
        sphere = embed(vertices, faces, energy.targets)
        descent = Descent(faces, len(order), callback and _in_order(callback, order))
        smooth = _toward_shape(descent, energy, SMOOTH, sphere, max_iterations, tolerance)
        if rounds is None:
            sphere = _descend(descent, energy, smooth, max_iterations, tolerance)
        else:
            sphere = toward_exact_face_areas(descent, _of_both_measures(energy), smooth, rounds)
        if exact_areas:
            true = areas * (4 * np.pi / areas.sum())
            sphere = with_exact_vertex_areas(energy, sphere, true, tolerance)
    require_bijective(sphere, faces, _WAY_OUT)
    return _restored(sphere, order)


def _energy(
    faces: NDArray[np.int64],
    areas: NDArray[np.float64],
    cotangents: NDArray[np.float64],
    area_weight: float,
    shape_weight: float,
) -> MapEnergy:
    shares = _in_single(areas / areas.mean())
    targets = shares * (4 * np.pi / shares.sum())
    # Between uniform weights, with which slivers rule, and areas, with which they are ignored.
    weights = area_weight * np.sqrt(targets * targets.mean())
    return MapEnergy(
        faces, targets, weights, _in_single(cotangents), shape_weight, np.zeros(len(faces))
    )


def _of_both_measures(energy: MapEnergy) -> MapEnergy:
    """Weigh faces half alike, as std(r - 1) does, and half by squared areas, as δh·A does.

    Near its end a descent is then ruled neither by slivers nor by the largest faces.
    """
    squares = energy.targets**2
    shares = 0.5 + 0.5 * squares / squares.mean()
    return replace(energy, weights=energy.weights.mean() * shares)


def _in_single(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return values.astype(np.float32).astype(np.float64)


def _toward_shape(
    descent: Descent,
    energy: MapEnergy,
    shape: float,
    sphere: NDArray[np.float64],
    max_iterations: int,
    tolerance: float,
) -> NDArray[np.float64]:
    """Descend a little with a weight of shape on the way down to that of the energy."""
    if energy.shape >= shape:
        return sphere
    return descent.minimize(
        replace(energy, shape=shape),
        sphere,
        max_iterations=min(_PATH_ITERATIONS, max_iterations - descent.iterations),
        tolerance=max(tolerance, _PATH_TOLERANCE),
    )


def _descend(
    descent: Descent,
    energy: MapEnergy,
    smooth: NDArray[np.float64],
    max_iterations: int,
    tolerance: float,
) -> NDArray[np.float64]:
    """Follow the minimum from a smooth map down to the weight of shape that was asked for."""
    sphere = _toward_shape(descent, energy, _BETWEEN, smooth, max_iterations, tolerance)
    return descent.minimize(
        energy,
        sphere,
        max_iterations=max_iterations - descent.iterations,
        tolerance=tolerance,
    )


def _restored(sphere: NDArray[np.float64], order: NDArray[np.int64]) -> NDArray[np.float64]:
    """Put points (V, 3) back into the vertex order of the mesh."""
    restored = np.empty_like(sphere)
    restored[order] = sphere
    return restored


def _in_order(callback: Callback, order: NDArray[np.int64]) -> Callback:
    """Tell a callback in the vertex order of the mesh."""

    def tell(iteration: Iteration) -> None:
        callback(replace(iteration, sphere=_restored(iteration.sphere, order)))

    return tell
