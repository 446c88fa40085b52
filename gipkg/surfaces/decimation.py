"""Fewer vertices on the same surface: edges collapse, the topology stays."""

from __future__ import annotations

import numpy as np

from gipkg.compilation import compiled
from gipkg.surfaces.areas import at_vertices, face_areas
from gipkg.surfaces.edge_collapse import collapse, following, gather_ring
from gipkg.surfaces.halfedges import twins
from gipkg.surfaces.quadrics import best_point, vertex_quadrics
from gipkg.surfaces.triangles import Triangles

BATCH = 0.25
"""Share of the edges, the cheapest, that may collapse before costs are computed anew."""

SLOWEST = 0.01
"""Where fewer of the vertices leave in a round, faces may turn over from then on, and where
fewer still do, all edges are tried."""

STEEPEST = 0.2
"""Least cosine between a face's normals before and after a collapse."""


def decimate(mesh: Triangles, size: int) -> Triangles:
    """Collapse edges until `size` vertices are left, those of least quadric error first.

    A collapse needs two neighbours that its ends share, and no more: then the surface stays
    what it is (T. K. Dey, H. Edelsbrunner, S. Guha, D. V. Nekhayev, Topology Preserving Edge
    Contraction, Publications de l'Institut Mathématique 66, 1999). A vertex is original where
    at least half of the area that went into it is. On a surface of genus 0 some edge can always
    collapse (Steinitz); one with handles may end above `size`.

    Parameters
    ----------
    mesh : Triangles
        Closed, manifold, oriented, of one component.
    size : int
        At least 4.
    """
    if len(mesh.vertices) <= size:
        return mesh
    centre = mesh.vertices.mean(axis=0)
    points, faces = mesh.vertices - centre, mesh.faces
    areas = at_vertices(face_areas(points, faces), faces, len(points))
    original = areas * mesh.original
    quadrics = vertex_quadrics(points, faces, areas)
    twin, origin = twins(faces), faces.ravel().copy()
    outgoing = np.zeros(len(points), np.int64)
    outgoing[origin] = np.arange(len(origin))
    alive = np.ones(len(faces), np.bool_)
    left, batch, turning = len(points), BATCH, False
    while left > size:
        costs, edges = _costs(points, quadrics, twin, origin, alive)
        order = edges[np.argsort(costs, kind="stable")[: max(64, int(batch * len(edges)))]]
        done = _collapse_round(
            order,
            left - size,
            turning,
            points,
            quadrics,
            areas,
            original,
            twin,
            origin,
            outgoing,
            alive,
        )
        if done < SLOWEST * left:
            if batch == 1 and not done:
                break
            batch, turning = 1 if turning else BATCH, True
        left -= done
    corners = origin.reshape(-1, 3)[alive]
    return Triangles(points + centre, corners, original >= areas / 2).compact()


@compiled
def _costs(points, quadrics, twin, origin, alive):  # type: ignore[no-untyped-def]
    """Return the error of collapsing every edge, and the half-edge that names it."""
    costs = np.empty(len(origin) // 2)
    edges = np.empty(len(origin) // 2, np.int64)
    point = np.empty(3)
    count = 0
    for h in range(len(origin)):
        if alive[h // 3] and h < twin[h]:
            costs[count] = best_point(quadrics[origin[h]], quadrics[origin[twin[h]]], point)
            edges[count] = h
            count += 1
    return costs[:count], edges[:count]


@compiled
def _collapse_round(  # type: ignore[no-untyped-def]
    order, most, turning, points, quadrics, areas, original, twin, origin, outgoing, alive
):
    """Collapse edges in order, at most one at a vertex, and count them."""
    size = len(points)
    free = np.ones(size, np.bool_)
    ring, other = np.empty(size, np.int64), np.empty(size, np.int64)
    spokes, other_spokes = np.empty(size, np.int64), np.empty(size, np.int64)
    mark = np.full(size, -1, np.int64)
    point = np.empty(3)
    done = 0
    for h in order:
        if done == most:
            break
        # An earlier collapse of the round may have removed the edge or changed its ends.
        if not alive[h // 3]:
            continue
        leaving, staying = origin[h], origin[following(h)]
        if not (free[leaving] and free[staying]):
            continue
        degree = gather_ring(twin, origin, h, ring, spokes)
        valence = gather_ring(twin, origin, twin[h], other, other_spokes)
        if _shared(ring, degree, other, valence, mark, leaving) != 2:
            continue
        best_point(quadrics[leaving], quadrics[staying], point)
        if not turning and (
            _turns_over(points, origin, spokes, degree, point)
            or _turns_over(points, origin, other_spokes, valence, point)
        ):
            continue
        alive[spokes[0] // 3] = False
        alive[spokes[degree - 1] // 3] = False
        collapse(twin, origin, outgoing, spokes, degree)
        points[staying] = point
        quadrics[staying] += quadrics[leaving]
        areas[staying] += areas[leaving]
        original[staying] += original[leaving]
        free[staying] = False
        done += 1
    return done


@compiled
def _shared(ring, degree, other, valence, mark, name):  # type: ignore[no-untyped-def]
    """Count the vertices that are in both rings."""
    for k in range(degree):
        mark[ring[k]] = name
    shared = 0
    for k in range(valence):
        shared += mark[other[k]] == name
    return shared


@compiled
def _turns_over(points, origin, spokes, degree, point):  # type: ignore[no-untyped-def]
    """Tell whether a face that stays turns too far when the vertex of the spokes moves.

    The first and the last spoke's faces, on both sides of the collapsing edge, go.
    """
    before, after = np.empty(3), np.empty(3)
    for k in range(1, degree - 1):
        a, h = spokes[k], following(spokes[k])
        p, q, r = points[origin[a]], points[origin[h]], points[origin[following(h)]]
        _normal(p, q, r, before)
        _normal(point, q, r, after)
        cosine = before[0] * after[0] + before[1] * after[1] + before[2] * after[2]
        length = (before * before).sum() * (after * after).sum()
        if cosine <= STEEPEST * np.sqrt(length):
            return True
    return False


@compiled
def _normal(p, q, r, normal):  # type: ignore[no-untyped-def]
    """Write the cross product of two sides of a triangle."""
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        normal[k] = (q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i])
