"""Maps with exact vertex areas, and the least energy that this leaves.

A map of V vertices has 2V coordinates and V vertex areas to meet, one of which follows from the
total of 4π: enough freedom to meet all of them exactly, and to choose among the maps that do. The
2V - 4 face areas would leave none. Sequential quadratic programming finds a map of least energy
among those with exact vertex areas (Nocedal & Wright, Numerical Optimization, Chapter 18).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from gipkg.cholesky import Cholesky, NotPositiveDefinite
from gipkg.errors import ParametrizationError
from gipkg.parametrizers.sphere.areas import area_gradients, signed_spherical_areas
from gipkg.parametrizers.sphere.tangent import move, tangent_basis
from gipkg.parametrizers.variational.energy import MapEnergy

EXACT = 1e-10
"""Relative error of the vertex areas, root mean square, up to which they count as exact."""
_ROUND_OFF = 1e-12
"""Below this it is not lowered further; very thin faces may end a little above."""
_NEAR = 1e-4
"""Error from which the areas are met by Newton's method alone."""
_ITERATIONS, _RESTORATIONS = (10, 40), 20
"""At most; the second number where the areas were out of reach after the first."""
_NUDGES, _NUDGE = 3, 0.05
"""How often a stuck map is moved at random, and by how much of the size of a star."""
_START_DAMPING, _LEAST_DAMPING, _MOST_DAMPING = 1e-2, 1e-9, 1e5
_SHORTEST_STEP = 1e-2
_SUFFICIENT = 0.1
"""Share of the promised decrease that a step has to bring."""
_STIFFNESS = 1e7
"""Of the constraints beside the energy's curvature; the multipliers do the rest."""
_MULTIPLIER_STEPS, _LEFT = 100, 1e-6
"""Steps at most, and the share of the errors that they may leave."""


@dataclass
class _Iterate:
    """A map, its energy, and the relative errors of all vertex areas."""

    sphere: NDArray[np.float64]
    value: float
    errors: NDArray[np.float64]

    @property
    def error(self) -> float:
        return float(np.sqrt(np.mean(self.errors**2)))


def with_exact_vertex_areas(
    energy: MapEnergy, sphere: NDArray[np.float64], areas: NDArray[np.float64], tolerance: float
) -> NDArray[np.float64]:
    """Move a bijective map to one of least energy with exact vertex areas.

    Parameters
    ----------
    energy : MapEnergy
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    areas : (F,) float64 array
        Of the faces, summing to 4π; a third of each goes to each of its vertices.
    tolerance : float
        Relative decrease of the energy at which a map with exact areas is good enough.

    Returns
    -------
    (V, 3) float64 array

    Raises
    ------
    ParametrizationError
        The areas were not reached without a flip.
    """
    search = _Search(energy, areas, len(sphere))
    here = _closest(search, search.at(sphere), tolerance)
    for seed in range(_NUDGES):
        if here.error <= EXACT:
            break
        nudged = search.nudged(here, seed)
        here = min(here, _closest(search, nudged, tolerance), key=lambda one: one.error)
    if here.error > EXACT:
        raise ParametrizationError(
            f"exact vertex areas were not reached without a flip: the error stays at "
            f"{here.error:.1e}; "
            "refine the mesh where it has few vertices around thin parts, or leave exact_areas off"
        )
    return here.sphere


def _closest(search: _Search, here: _Iterate, tolerance: float) -> _Iterate:
    """Descend to little energy near exact areas, then go to the areas; longer if that fails."""
    there = here
    for iterations in _ITERATIONS:
        here = _descended(search, here, iterations, tolerance)
        there = _restored(search, here)
        if there.error <= EXACT:
            break
    return there


def _descended(search: _Search, here: _Iterate, iterations: int, tolerance: float) -> _Iterate:
    for _ in range(iterations):
        found = search.step(here)
        if found is None:
            break
        change, here = abs(here.value - found.value), found
        if here.error < _NEAR and change <= tolerance * here.value:
            break
    return here


def _restored(search: _Search, here: _Iterate) -> _Iterate:
    for _ in range(_RESTORATIONS):
        found = None if here.error < _ROUND_OFF else search.restore(here)
        if found is None:
            break
        here = found
    return here


class _Search:
    """Steps of the constrained descent over one mesh, damped until they keep what they promise."""

    def __init__(self, energy: MapEnergy, areas: NDArray[np.float64], count: int) -> None:
        faces = energy.faces
        self._energy = energy
        self._share = sp.csr_array(
            (np.full(faces.size, 1 / 3), (faces.ravel(), np.repeat(np.arange(len(faces)), 3))),
            shape=(count, len(faces)),
        )
        self._wanted = self._share @ areas
        # One area follows from the others, with the sum of their errors: the largest bears it best.
        self._equations = np.delete(np.arange(count), self._wanted.argmax())
        self._unknowns = (2 * faces[:, :, None] + np.arange(2)).reshape(len(faces), 6)
        self._damping, self._price = _START_DAMPING, 0.0

    def at(self, sphere: NDArray[np.float64]) -> _Iterate:
        reached = self._share @ signed_spherical_areas(sphere, self._energy.faces)
        return _Iterate(sphere, self._energy.value(sphere), reached / self._wanted - 1)

    def step(self, here: _Iterate) -> _Iterate | None:
        """Step towards less energy and smaller errors; None if damping leads to no such step."""
        basis, gradient, hessian, metric, jacobian = self._model(here)
        while self._damping < _MOST_DAMPING:
            curvature = hessian + self._damping * metric
            step = _constrained_step(curvature, gradient, jacobian, here.errors[self._equations])
            if step is not None:
                model = float(gradient @ step + 0.5 * step @ (curvature @ step))
                found = self._searched(here, basis, step, model)
                if found is not None:
                    return found
            self._damping *= 8
        return None

    def restore(self, here: _Iterate) -> _Iterate | None:
        """Meet the linearised areas by the least change of the map; None where that fails."""
        basis, gradient, hessian, metric, jacobian = self._model(here)
        step = _constrained_step(
            hessian + metric, 0 * gradient, jacobian, here.errors[self._equations]
        )
        length = 1.0
        while step is not None and length >= _SHORTEST_STEP:
            there = self.at(move(here.sphere, basis, length * step))
            if np.isfinite(there.value) and there.error < here.error:
                return there
            length /= 2
        return None

    def nudged(self, here: _Iterate, seed: int) -> _Iterate:
        """Move all vertices a little at random, without a flip.

        Where the map has all symmetries of a regular mesh, no step changes the areas that the
        symmetries fix, and only less symmetric maps have them right.
        """
        self._damping, self._price = _START_DAMPING, 0.0
        basis = tangent_basis(here.sphere)
        directions = np.random.default_rng(seed).standard_normal(2 * len(here.sphere))
        lengths = np.repeat(np.sqrt(self._wanted), 2)
        size = _NUDGE
        while not np.isfinite(
            (there := self.at(move(here.sphere, basis, size * lengths * directions))).value
        ):
            size /= 2
        return there

    def _model(self, here: _Iterate) -> tuple[Any, ...]:
        basis = tangent_basis(here.sphere)
        gradient, *blocks = self._energy.derivatives(here.sphere, basis)
        hessian, metric = map(self._assembled, blocks)
        return basis, gradient, hessian, metric, self._jacobian(here.sphere, basis)

    def _searched(
        self, here: _Iterate, basis: NDArray[np.float64], step: NDArray[np.float64], model: float
    ) -> _Iterate | None:
        """Halve a step until energy plus price of the errors falls as the model promises."""
        missing = float(np.linalg.norm(here.errors))
        if here.error > _ROUND_OFF:
            self._price = max(self._price, 2 * model / missing)
        promised = min(model, 0.0) - self._price * missing * (here.error > _ROUND_OFF)
        length = 1.0
        while length >= _SHORTEST_STEP:
            there = self.at(move(here.sphere, basis, length * step))
            change = there.value - here.value
            change += self._price * (float(np.linalg.norm(there.errors)) - missing)
            if change <= _SUFFICIENT * length * promised:
                if length == 1:
                    self._damping = max(self._damping / 4, _LEAST_DAMPING)
                return there
            length /= 2
        return None

    def _assembled(self, blocks: NDArray[np.float64]) -> sp.csr_array:
        rows = np.repeat(self._unknowns, 6, axis=1).ravel()
        columns = np.tile(self._unknowns, (1, 6)).ravel()
        size = 2 * len(self._wanted)
        return sp.csr_array((blocks.ravel(), (rows, columns)), shape=(size, size))

    def _jacobian(self, sphere: NDArray[np.float64], basis: NDArray[np.float64]) -> sp.csr_array:
        """Slopes of all errors but one in the tangent coordinates, (V - 1, 2V)."""
        faces = self._energy.faces
        slopes = np.einsum("fkc,fkdc->fkd", area_gradients(sphere, faces), basis[faces])
        by_face = sp.csr_array(
            (slopes.ravel(), self._unknowns.ravel(), 6 * np.arange(len(faces) + 1)),
            shape=(len(faces), 2 * len(sphere)),
        )
        return (sp.diags_array(1 / self._wanted) @ (self._share @ by_face)).tocsr()[self._equations]


def _constrained_step(
    curvature: sp.csr_array,
    gradient: NDArray[np.float64],
    jacobian: sp.csr_array,
    errors: NDArray[np.float64],
) -> NDArray[np.float64] | None:
    """Minimise the quadratic model (2V,) where the linearised errors vanish.

    The method of multipliers keeps the system positive definite and no larger than the model's;
    it is stiff enough for a few steps to reach round-off. Every constraint is scaled by what the
    curvature opposes to it, since stars may be of very different sizes.
    """
    compliance = jacobian.multiply(jacobian) @ (1 / curvature.diagonal())
    scale = np.sqrt(_STIFFNESS / compliance)
    jacobian = (sp.diags_array(scale) @ jacobian).tocsr()
    errors = scale * errors
    try:
        factor = Cholesky.of(curvature + jacobian.T @ jacobian)
    except NotPositiveDefinite:
        return None
    multipliers = np.zeros_like(errors)
    step = np.zeros_like(gradient)
    for _ in range(_MULTIPLIER_STEPS):
        step = -factor.solve(gradient + jacobian.T @ (multipliers + errors))
        left = jacobian @ step + errors
        multipliers += left
        if np.linalg.norm(left) <= _LEFT * np.linalg.norm(errors):
            break
    return step
