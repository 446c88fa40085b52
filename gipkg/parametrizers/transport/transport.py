"""Optimal transport from uniform area to weighted points, however close together they are.

A conformal map puts whole limbs into spots where a convex hull in double precision cannot tell
one vertex from the next. Such vertices wait: the nearest vertex that has a cell stands for them.
Once its cell is as large as they all need, they are told apart inside it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from gipkg.api import Callback, Iteration
from gipkg.parametrizers.transport.newton import SHORT_STEP, newton_step
from gipkg.parametrizers.transport.power_diagram import PowerDiagram, power_diagram

_LEAST_AREA = 1e-10
"""Steradians; the hull's round-off can undo smaller cells."""
_LEAST_SHARE = 1e-2
"""Share of its area that a waiting site must find to be let in."""
_ROUGH = 1e-3
"""Share of area in wrong cells at which waiting vertices are let in."""
_SPREAD = 0.5
"""Share of a cell's radius over which the vertices let into it are spread."""


def transport(
    sites: NDArray[np.float64],
    areas: NDArray[np.float64],
    *,
    max_iterations: int,
    tolerance: float,
    callback: Callback | None = None,
) -> NDArray[np.float64]:
    """Move every site to the centroid of the cell that optimal transport gives it.

    Parameters
    ----------
    sites : (V, 3) float64 array
        Unit vectors.
    areas : (V,) float64 array
        Positive, summing to 4π.
    max_iterations : int
    tolerance : float
        Stop when this share of the sphere, or less, lies in the wrong cell.
    callback : callable, optional
        Told every iteration, with the share in the wrong cell as objective.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors; the same one for sites that could not be told apart.
    """
    sphere = sites
    for number, stage in enumerate(_stages(sites, areas, tolerance)):
        if number > 0:
            sphere = stage.centroids
        if callback:
            callback(Iteration(number, sphere, stage.misplaced, stage.step))
        if number == max_iterations:
            break
    return sphere


@dataclass(frozen=True, slots=True)
class _Stage:
    """Centroids (V, 3) of the cells of all sites, the share misplaced, and the last step."""

    centroids: NDArray[np.float64]
    misplaced: float
    step: float


def _stages(
    sites: NDArray[np.float64], areas: NDArray[np.float64], tolerance: float
) -> Iterator[_Stage]:
    """Balance the sites that can be told apart, let in more, and so on to the last."""
    weights = np.zeros(len(sites))
    present = _told_apart(sites, weights, np.full(len(sites), _LEAST_AREA))
    while True:
        owners, wanted, diagram = _gather(sites, areas, weights, present)
        yield _stage(diagram, wanted, owners, 0.0)
        enough = tolerance if len(present) == len(sites) else _ROUGH
        before, now, longest = np.inf, _misplaced(diagram, wanted), 1.0
        while enough < now < before:
            step = newton_step(sites[present], wanted, weights[present], diagram, longest)
            if step is None:
                break
            # Every length that is tried costs a hull, and the next one is seldom much longer.
            longest = min(1.0, max(2 * step.length, 2 * SHORT_STEP))
            weights[present], diagram = step.weights, step.diagram
            if not step.kept.all():
                present = present[step.kept]
                owners, wanted, diagram = _gather(sites, areas, weights, present)
            before, now = now, _misplaced(diagram, wanted)
            yield _stage(diagram, wanted, owners, step.length)
        weights = _let_in(sites, weights, present[owners], diagram, owners)
        least = np.maximum(_LEAST_AREA, _LEAST_SHARE * areas)
        least[present] = _LEAST_AREA
        told_apart = _told_apart(sites, weights, least)
        if np.array_equal(told_apart, present):
            return
        present = told_apart


def _gather(
    sites: NDArray[np.float64],
    areas: NDArray[np.float64],
    weights: NDArray[np.float64],
    present: NDArray[np.intp],
) -> tuple[NDArray[np.intp], NDArray[np.float64], PowerDiagram]:
    """Who stands for each site, the area they want together, and the diagram of those present."""
    owners = cKDTree(sites[present]).query(sites)[1]
    owners[present] = np.arange(len(present))
    diagram = power_diagram(np.exp(weights[present])[:, None] * sites[present])
    wanted = np.asarray(np.bincount(owners, areas, len(present)), np.float64)
    return owners, wanted, diagram


def _misplaced(diagram: PowerDiagram, wanted: NDArray[np.float64]) -> float:
    return float(np.abs(diagram.areas - wanted).sum() / (8 * np.pi))


def _stage(
    diagram: PowerDiagram,
    wanted: NDArray[np.float64],
    owners: NDArray[np.intp],
    step: float,
) -> _Stage:
    return _Stage(diagram.centroids[owners], _misplaced(diagram, wanted), step)


def _told_apart(
    sites: NDArray[np.float64], weights: NDArray[np.float64], least: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Find the indices of the sites whose cells have more than the `least` areas (V,)."""
    areas = power_diagram(np.exp(weights)[:, None] * sites).areas
    return np.flatnonzero(areas > least)


def _let_in(
    sites: NDArray[np.float64],
    weights: NDArray[np.float64],
    parents: NDArray[np.intp],
    diagram: PowerDiagram,
    cells: NDArray[np.intp],
) -> NDArray[np.float64]:
    """Give waiting sites weights that divide their parents' cells among them.

    In gnomonic coordinates about a cell's centroid the competition of sites g near their parent
    is that of the linear functions y·g + h. With h = -a |g|² / 2 they have the Voronoi cells of
    the points a g: the cluster is magnified by a, here to a part of the cell it has together.

    Parameters
    ----------
    sites : (V, 3) float64 array
    weights : (V,) float64 array
        Of waiting sites without meaning.
    parents : (V,) int array
        The site that stands for each; itself for those that have a cell.
    diagram : PowerDiagram
        Of those that have a cell.
    cells : (V,) int array
        The cell in it where each belongs.

    Returns
    -------
    (V,) float64 array
    """
    centre = diagram.centroids[cells]
    apart = sites - sites[parents]
    height, parent_height = (
        np.einsum("vc,vc->v", centre, points) for points in (sites, sites[parents])
    )
    lift = np.einsum("vc,vc->v", centre, apart)
    gnomonic = (apart - (lift / parent_height)[:, None] * sites[parents]) / height[:, None]
    length = np.linalg.norm(gnomonic, axis=1)
    reach = np.zeros(len(diagram.areas))
    np.maximum.at(reach, cells, length)
    radius = _SPREAD * np.sqrt(diagram.areas / np.pi)
    magnification = np.divide(radius, reach, out=np.zeros_like(reach), where=reach > 0)
    return weights[parents] - np.log1p(lift / parent_height) - magnification[cells] * length**2 / 2
