"""Latitude and longitude by diffusion from two poles: the start of CALD.

After Brechbühler, Gerig & Kübler, Parametrization of closed surfaces for 3-D shape description,
CVIU 1995, whose two Laplace equations hold on the edge graph of any closed genus-0 mesh. Nothing
keeps its faces from flipping, and limbs shrink exponentially with their length.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from gipkg.cholesky import Cholesky
from gipkg.compilation import compiled
from gipkg.parametrizers.cald.stars import Stars


def diffuse(vertices: NDArray[np.float64], stars: Stars) -> NDArray[np.float64]:
    """Map a closed genus-0 mesh to the sphere by two harmonic functions.

    The poles are two vertices far apart on the surface and not neighbours, which any mesh but
    the tetrahedron has.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    stars : Stars
        Of the same mesh.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors; faces may be flipped.
    """
    north, south = _poles(vertices, stars)
    latitude = _latitude(stars, north, south)
    longitude = _longitude(stars, north, south)
    ring = np.sin(latitude)
    return np.column_stack((ring * np.cos(longitude), ring * np.sin(longitude), np.cos(latitude)))


def _poles(vertices: NDArray[np.float64], stars: Stars) -> tuple[int, int]:
    """Find a vertex far out and the one farthest from it along edges."""
    origin = np.repeat(np.arange(len(vertices)), np.diff(stars.offsets))
    lengths = np.linalg.norm(vertices[origin] - vertices[stars.ring], axis=1)
    graph = csr_array((lengths, stars.ring, stars.offsets))
    outermost = np.linalg.norm(vertices - vertices.mean(axis=0), axis=1).argmax()
    adjacent_to_all = np.diff(stars.offsets) == len(vertices) - 1
    north = np.where(adjacent_to_all, -1, dijkstra(graph, indices=outermost)).argmax()
    distances = dijkstra(graph, indices=north)
    distances[stars.ring[stars.offsets[north] : stars.offsets[north + 1]]] = -1
    return int(north), int(distances.argmax())


def _latitude(stars: Stars, north: int, south: int) -> NDArray[np.float64]:
    """Solve for the polar angle: harmonic, 0 at the north pole and π at the south pole."""
    fixed = np.zeros(len(stars.offsets) - 1, np.bool_)
    fixed[[north, south]] = True
    values = np.zeros(len(fixed))
    values[south] = np.pi
    return _harmonic(stars, fixed, values, np.zeros(len(stars.ring)))


def _longitude(stars: Stars, north: int, south: int) -> NDArray[np.float64]:
    """Solve for the azimuth: harmonic without the poles, growing by 2π around them."""
    count = len(stars.offsets) - 1
    line = _date_line(stars, north, south)
    jumps = _jumps(stars.offsets, stars.ring, line)
    weights = np.ones(len(stars.ring))
    origin = np.repeat(np.arange(count), np.diff(stars.offsets))
    for pole in (north, south):
        weights[(origin == pole) | (stars.ring == pole)] = 0
    fixed = np.zeros(count, np.bool_)
    fixed[[north, south, line[1]]] = True
    return _harmonic(stars, fixed, np.zeros(count), 2 * np.pi * jumps, weights)


def _harmonic(
    stars: Stars,
    fixed: NDArray[np.bool_],
    values: NDArray[np.float64],
    jumps: NDArray[np.float64],
    weights: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Solve ``sum(weight * (value[ring] + jump - value)) = 0`` at the vertices not fixed."""
    if weights is None:
        weights = np.ones(len(stars.ring))
    count = len(fixed)
    origin = np.repeat(np.arange(count), np.diff(stars.offsets))
    number = np.cumsum(~fixed) - 1
    known = fixed[stars.ring]
    right = np.bincount(origin, weights * (jumps + known * values[stars.ring]), count)[~fixed]
    diagonal = np.bincount(origin, weights, count)[~fixed]
    inner = ~known & ~fixed[origin]
    free = np.arange(len(right))
    rows = np.r_[free, number[origin[inner]]]
    columns = np.r_[free, number[stars.ring[inner]]]
    entries = np.r_[diagonal, -weights[inner]]
    matrix = csr_array((entries, (rows, columns)), shape=(len(right), len(right)))
    result = values.copy()
    result[~fixed] = Cholesky.of(matrix).solve(right.astype(np.float64))
    return result


def _date_line(stars: Stars, north: int, south: int) -> NDArray[np.int64]:
    """Find a path from pole to pole with the fewest edges, which therefore has no chord."""
    graph = csr_array((np.ones(len(stars.ring)), stars.ring, stars.offsets))
    _, before = dijkstra(graph, indices=north, unweighted=True, return_predecessors=True)
    line = [south]
    while line[-1] != north:
        line.append(int(before[line[-1]]))
    return np.array(line[::-1])


@compiled
def _jumps(offsets, ring, line):  # type: ignore[no-untyped-def]
    """Mark the half-edges that leave the date line to its west with -1, their twins with 1."""
    jumps = np.zeros(len(ring))
    for i in range(1, len(line) - 1):
        v = line[i]
        begin, degree = offsets[v], offsets[v + 1] - offsets[v]
        k = 0
        while ring[begin + k] != line[i - 1]:
            k += 1
        k = (k + 1) % degree
        while ring[begin + k] != line[i + 1]:
            w = ring[begin + k]
            jumps[begin + k] = -1.0
            for back in range(offsets[w], offsets[w + 1]):
                if ring[back] == v:
                    jumps[back] = 1.0
            k = (k + 1) % degree
    return jumps
