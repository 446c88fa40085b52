"""Newton's step towards the weights that give every cell of a power diagram its area.

The weights maximise Kantorovich's dual functional, which is concave; its gradient is what the
cells lack, its Hessian minus the Laplacian of the cells' sides weighted by their slopes. The step
is damped so that next to no cell vanishes (Kitagawa, Mérigot & Thibert, Convergence of a Newton
algorithm for semi-discrete optimal transport, J. Eur. Math. Soc. 2019).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from gipkg.cholesky import Cholesky
from gipkg.parametrizers.transport.power_diagram import PowerDiagram, power_diagram

_GROWTH = 4.0
"""Most by which one step asks a cell to grow or shrink; beyond it Newton's model is worthless."""
_KEPT = 0.1
"""A cell with less than this share of its area, and of the area asked for, is given up."""
_GIVEN_UP = 1e-3
"""Share of the cells that a step may give up once damping alone has not kept them."""
SHORT_STEP = 0.125
"""From here on a step may give up cells; longer ones are to be tried first."""
_FARTHEST = 1.0
"""Most by which a step changes a weight."""
_SHORTEST_STEP = 1e-3
_REGULARIZATION = 1e-11
"""Relative shift of the diagonal: the Laplacian does not see a constant."""


@dataclass(frozen=True, slots=True)
class Step:
    """Weights (N,) reached, their diagram, which cells (N,) are kept, and the step's length."""

    weights: NDArray[np.float64]
    diagram: PowerDiagram
    kept: NDArray[np.bool_]
    length: float


def newton_step(
    sites: NDArray[np.float64],
    areas: NDArray[np.float64],
    weights: NDArray[np.float64],
    diagram: PowerDiagram,
    longest: float = 1.0,
) -> Step | None:
    """Bring the areas of cells closer to those that are wanted.

    Parameters
    ----------
    sites : (N, 3) float64 array
        Unit vectors.
    areas : (N,) float64 array
        Wanted; positive, summing to 4π.
    weights : (N,) float64 array
    diagram : PowerDiagram
        Of the sites with these weights; every site has a cell.
    longest : float
        Length of the step that is tried first; 1 is Newton's own.

    Returns
    -------
    Step or None
        None if every step makes too many cells vanish.
    """
    asked = diagram.areas * np.clip(areas / diagram.areas, 1 / _GROWTH, _GROWTH)
    asked *= 4 * np.pi / asked.sum()
    direction = _direction(diagram, asked)
    least = _KEPT * np.minimum(diagram.areas, asked)
    length = min(longest, _FARTHEST / np.abs(direction).max(initial=_FARTHEST))
    while length > _SHORTEST_STEP:
        reached = weights + length * direction
        candidate = power_diagram(np.exp(reached)[:, None] * sites)
        # A negative slope is of a cell that reaches farther from its site than a right angle.
        kept = (candidate.areas > least) & (candidate.slopes.min() >= 0)
        allowed = _GIVEN_UP * len(sites) if length <= SHORT_STEP else 0
        if np.count_nonzero(~kept) <= allowed:
            return Step(reached, candidate, kept, length)
        length /= 2
    return None


def _direction(diagram: PowerDiagram, asked: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solve for the change of weights (N,) that gives the areas (N,) to first order."""
    count = len(asked)
    first, second = diagram.sides.T
    diagonal = sum(np.bincount(end, diagram.slopes, count) for end in (first, second))
    every = np.arange(count)
    system = sp.csr_array(
        (
            np.concatenate((-diagram.slopes, -diagram.slopes, diagonal * (1 + _REGULARIZATION))),
            (np.concatenate((first, second, every)), np.concatenate((second, first, every))),
        )
    )
    direction = Cholesky.of(system).solve(asked - diagram.areas)
    return direction - direction.mean()
