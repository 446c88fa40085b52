"""Coarse-to-fine hierarchy of a closed genus-0 mesh, down to a tetrahedron.

Vertices leave by half-edge collapses, an independent set a level. Every triangulation of the
sphere but the tetrahedron has a collapsible edge (Steinitz), so the coarsening always ends
there. The area of removed faces passes to the faces that replace them: a limb that has shrunk
to one coarse vertex still claims the room that it needs on the sphere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.surfaces.edge_collapse import collapse, gather_ring
from gipkg.surfaces.halfedges import twins

_DEGREE = 8
"""Vertices above this valence wait until nothing else is left to collapse."""


@dataclass(frozen=True)
class Hierarchy:
    """The tetrahedron and everything needed to refine it again.

    Attributes
    ----------
    twin, origin : (3F,) int64 arrays
        Half-edges; those of removed faces keep what they had before their removal.
    outgoing : (V,) int64 array
        A half-edge from every vertex still present.
    areas : (F,) float64 array
        Area carried by every face, summing to 4π over those present.
    present : (F,) bool array
        Faces of the tetrahedron.
    vertices, spokes : (V - 4,) int64 arrays
        Removed vertices in order of removal, and the half-edge each one left along.
    levels : (L + 1,) int64 array
        Level l removed ``vertices[levels[l]:levels[l + 1]]``, no two of them adjacent.
    offsets : (V - 3,) int64 array
        ``star_areas[offsets[i]:offsets[i + 1]]`` are the areas of the faces around removed
        vertex i before it left.
    star_areas : float64 array
    """

    twin: NDArray[np.int64]
    origin: NDArray[np.int64]
    outgoing: NDArray[np.int64]
    areas: NDArray[np.float64]
    present: NDArray[np.bool_]
    vertices: NDArray[np.int64]
    spokes: NDArray[np.int64]
    levels: NDArray[np.int64]
    offsets: NDArray[np.int64]
    star_areas: NDArray[np.float64]


def coarsen(
    vertices: NDArray[np.float64], faces: NDArray[np.integer], areas: NDArray[np.float64]
) -> Hierarchy:
    """Collapse a closed oriented genus-0 mesh to a tetrahedron.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    faces : (F, 3) integer array
    areas : (F,) float64 array
        Positive; the share of the sphere that each face should receive, summing to 4π.

    Returns
    -------
    Hierarchy
    """
    count = len(vertices)
    twin = twins(np.asarray(faces, np.int64))
    origin = faces.ravel().astype(np.int64)
    outgoing = np.zeros(count, np.int64)
    outgoing[origin] = np.arange(len(origin))
    carried = areas.astype(np.float64).copy()
    present = np.ones(len(faces), np.bool_)
    removed, spokes, levels, offsets, star_areas = _collapse_all(
        np.ascontiguousarray(vertices, np.float64), twin, origin, outgoing, carried, present
    )
    return Hierarchy(
        twin, origin, outgoing, carried, present, removed, spokes, levels, offsets, star_areas
    )


@compiled
def _collapse_all(points, twin, origin, outgoing, areas, present):  # type: ignore[no-untyped-def]
    count = len(points)
    alive = np.ones(count, np.bool_)
    ring, other = np.zeros(count, np.int64), np.zeros(count, np.int64)
    spokes, other_spokes = np.zeros(count, np.int64), np.zeros(count, np.int64)
    mark = np.full(count, -1, np.int64)
    degrees = np.zeros(count, np.int64)
    for h in range(len(origin)):
        degrees[origin[h]] += 1

    removed = np.zeros(count - 4, np.int64)
    removed_spokes = np.zeros(count - 4, np.int64)
    offsets = np.zeros(count - 3, np.int64)
    star_areas = np.zeros(8 * count, np.float64)
    levels = [0]
    done = 0
    limit = _DEGREE
    while done < count - 4:
        candidates = np.flatnonzero(alive)
        load = np.zeros(len(candidates))
        for i, v in enumerate(candidates):
            degree = gather_ring(twin, origin, outgoing[v], ring, spokes)
            for k in range(degree):
                load[i] += areas[spokes[k] // 3]
        free = np.ones(count, np.bool_)
        before = done
        for v in candidates[np.argsort(load, kind="mergesort")]:
            if done == count - 4:
                break
            if not free[v] or degrees[v] > limit:
                continue
            degree = gather_ring(twin, origin, outgoing[v], ring, spokes)
            for k in range(degree):
                mark[ring[k]] = v
            best = _best_target(
                points, twin, origin, outgoing, degrees, ring, degree, mark, v, other, other_spokes
            )
            if best < 0:
                continue
            degree = gather_ring(twin, origin, spokes[best], ring, spokes)
            if offsets[done] + degree > len(star_areas):
                star_areas = np.concatenate((star_areas, np.zeros(len(star_areas) + degree)))
            _hand_over_areas(areas, spokes, degree, star_areas[offsets[done] :])
            offsets[done + 1] = offsets[done] + degree
            for k in range(degree):
                free[ring[k]] = False
            degrees[ring[0]] += degree - 4
            degrees[ring[1]] -= 1
            degrees[ring[degree - 1]] -= 1
            present[spokes[0] // 3] = False
            present[spokes[degree - 1] // 3] = False
            removed[done] = v
            removed_spokes[done] = spokes[0]
            alive[v] = False
            collapse(twin, origin, outgoing, spokes, degree)
            done += 1
        if done == before:
            limit *= 2
        else:
            limit = _DEGREE
            levels.append(done)
    return removed, removed_spokes, np.array(levels), offsets, star_areas[: offsets[done]]


@compiled
def _best_target(  # type: ignore[no-untyped-def]
    points, twin, origin, outgoing, degrees, ring, degree, mark, v, other, other_spokes
):
    """Neighbour that `v` may be merged into with the shortest new edges; -1 if there is none.

    Merging keeps the mesh a manifold when the two share exactly two neighbours.
    """
    best, least = -1, np.float32(np.inf)
    for i in range(degree):
        u = ring[i]
        valence = gather_ring(twin, origin, outgoing[u], other, other_spokes)
        shared = 0
        for k in range(valence):
            if mark[other[k]] == v:
                shared += 1
        if shared != 2:
            continue
        length = 0.0
        for k in range(degree):
            for axis in range(3):
                length += (points[u, axis] - points[ring[k], axis]) ** 2
        # In single precision a motion of the mesh does not decide between equal lengths.
        cost = np.float32(length * max(1.0, (degrees[u] + degree - 4) / 6.0) ** 2)
        if cost < least:
            best, least = i, cost
    return best


@compiled
def _hand_over_areas(areas, spokes, degree, record):  # type: ignore[no-untyped-def]
    """Share the area of the two vanishing faces among the rest of the star; record the old."""
    for k in range(degree):
        record[k] = areas[spokes[k] // 3]
    share = (record[0] + record[degree - 1]) / (degree - 2)
    for k in range(1, degree - 1):
        areas[spokes[k] // 3] += share
