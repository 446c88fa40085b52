"""Limited-memory BFGS on the sphere's vertices, preconditioned by a Laplacian."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from gipkg.api import Callback, Iteration
from gipkg.cholesky import Cholesky
from gipkg.parametrizers.lbfgs import Memory, Preconditioner, Vectors
from gipkg.parametrizers.unconstrained.energy import ProjectedEnergy
from gipkg.surfaces.areas import at_vertices

_MEMORY = 8
"""Pairs of steps and changes of the gradient that are remembered."""
_SUFFICIENT = 1e-4
"""Share of the decrease that the slope promises which a step must bring (Armijo)."""
_SHORTEST_STEP = 1e-10


def minimize(
    energy: ProjectedEnergy,
    sphere: Vectors,
    precondition: Preconditioner,
    *,
    max_iterations: int,
    tolerance: float,
    callback: Callback | None = None,
) -> Vectors:
    """Descend from a map (V, 3) to one of less energy and the same degree.

    No step moves a vertex by more than half of the least distance of a triangle from the centre,
    so that the barrier there is not jumped.

    Parameters
    ----------
    energy : ProjectedEnergy
    sphere : (V, 3) float64 array
        Unit vectors.
    precondition : callable
        Approximates the product of the energy's inverse Hessian with a gradient (V, 3).
    max_iterations : int
    tolerance : float
        Stop when an iteration lowers the energy by less than this fraction.
    callback : callable, optional

    Returns
    -------
    (V, 3) float64 array
        Unit vectors.
    """
    vectors = sphere.copy()
    value, gradient = energy(vectors)
    if callback:
        callback(Iteration(0, sphere, value, 0.0))
    memory = Memory(_MEMORY)
    for number in range(1, max_iterations + 1):
        step = -memory.inverse_hessian(gradient, _scaled(precondition, memory))
        slope = float(np.vdot(gradient, step))
        length = _longest(energy, vectors, step)
        while length > _SHORTEST_STEP:
            moved = vectors + length * step
            reached, new_gradient = energy(moved)
            if reached <= value + _SUFFICIENT * length * slope:
                break
            length /= 2
        else:
            break
        memory.add(moved - vectors, new_gradient - gradient)
        gain = (value - reached) / value
        vectors, value, gradient = moved, reached, new_gradient
        sphere = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
        if callback:
            callback(Iteration(number, sphere, value, length))
        if gain < tolerance:
            break
    return sphere


def _longest(energy: ProjectedEnergy, vectors: Vectors, step: Vectors) -> float:
    """Share of a step, at most 1, at which no triangle can reach the centre.

    The gradient is tangential, so that vectors never get shorter than 1 and the sphere's points
    move no farther than they.
    """
    farthest = np.sqrt(np.einsum("vc,vc->v", step, step).max())
    clearance = energy.clearance(vectors)
    return float(min(1.0, 0.5 * clearance / farthest)) if farthest > 0 else 0.0


def _scaled(precondition: Preconditioner, memory: Memory) -> Preconditioner:
    """Scale a preconditioner to the curvature along the last step."""
    if memory.latest is None:
        return precondition
    step, change = memory.latest
    scale = np.vdot(step, change) / np.vdot(change, precondition(change))
    return lambda vectors: precondition(vectors) * scale


def laplacian_preconditioner(
    faces: NDArray[np.int64], cotangents: NDArray[np.float64], areas: NDArray[np.float64]
) -> Preconditioner:
    """Factorise the cotangent Laplacian plus the mass matrix.

    Parameters
    ----------
    faces : (F, 3) int64 array
        Of a closed mesh.
    cotangents : (F, 3) float64 array
        Positive.
    areas : (F,) float64 array
        Summing to 4π, so that the mass is small beside all but the smoothest modes.

    Returns
    -------
    callable
        Solves for (V, 3) right-hand sides.
    """
    count = int(faces.max()) + 1
    i, j = np.roll(faces, -1, axis=1).ravel(), np.roll(faces, -2, axis=1).ravel()
    weight = cotangents.ravel() / 2
    diagonal = at_vertices(areas, faces, count)
    diagonal += np.bincount(i, weight, count) + np.bincount(j, weight, count)
    every = np.arange(count)
    system = sp.csr_array(
        (
            np.concatenate((-weight, -weight, diagonal)),
            (np.concatenate((i, j, every)), np.concatenate((j, i, every))),
        )
    )
    return Cholesky.of(system).solve
