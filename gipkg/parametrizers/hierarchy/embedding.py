"""A bijective start on the sphere: the hierarchy's tetrahedron, refined vertex by vertex.

Praun & Hoppe (Spherical parametrization and remeshing, SIGGRAPH 2003) showed that a
progressive mesh can be embedded by inserting every vertex into the kernel of its star. Here the
faces carry the area they stand for, so that the embedding is close to authalic on every level.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.errors import ParametrizationError
from gipkg.parametrizers.hierarchy.coarsening import Hierarchy, coarsen
from gipkg.parametrizers.hierarchy.star import descend, star_energy
from gipkg.surfaces.edge_collapse import gather_ring, split

_SHAPE = 0.1
"""Weight of the conformal term against the area term on the way up."""
_SWEEPS = 4
"""Gauss-Seidel sweeps after every level; coarse levels, which are cheap, get more."""


def embed(
    vertices: NDArray[np.float64], faces: NDArray[np.integer], areas: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Embed a closed oriented genus-0 mesh in the sphere, close to prescribed areas.

    Parameters
    ----------
    vertices : (V, 3) float64 array
    faces : (F, 3) integer array
    areas : (F,) float64 array
        Positive; the area that each face should receive, summing to 4π.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors; no face is flipped and the degree is 1.

    Raises
    ------
    ParametrizationError
        A vertex could not be inserted without a flip.
    """
    hierarchy = coarsen(vertices, faces, areas)
    sphere = np.zeros((len(vertices), 3))
    sphere[np.unique(hierarchy.origin.reshape(-1, 3)[hierarchy.present])] = _tetrahedron(hierarchy)
    stuck = _refine(
        sphere,
        hierarchy.twin.copy(),
        hierarchy.origin.copy(),
        hierarchy.outgoing.copy(),
        hierarchy.areas.copy(),
        hierarchy.vertices,
        hierarchy.spokes,
        hierarchy.levels,
        hierarchy.offsets,
        hierarchy.star_areas,
        _SHAPE,
        _SWEEPS,
    )
    if stuck >= 0:
        raise ParametrizationError(
            f"no room on the sphere for vertex {stuck}: the mesh has faces too thin or small to "
            "embed in double precision; remesh it or merge its close vertices first"
        )
    return sphere


def _tetrahedron(hierarchy: Hierarchy) -> NDArray[np.float64]:
    """Corners of a regular tetrahedron for the four remaining vertices, oriented outwards."""
    corners = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3)
    names, faces = np.unique(
        hierarchy.origin.reshape(-1, 3)[hierarchy.present], return_inverse=True
    )
    if np.linalg.det(corners[faces.reshape(-1, 3)[0]]) < 0:
        corners = -corners
    return corners[: len(names)]


@compiled
def _refine(  # type: ignore[no-untyped-def]
    sphere, twin, origin, outgoing, areas, vertices, spokes, levels, offsets, star_areas, shape,
    sweeps,
):  # fmt: skip
    """Undo all collapses, level by level; -1, or the vertex that found no room."""
    count = len(sphere)
    ring, star = np.zeros(count, np.int64), np.zeros(count, np.int64)
    points, targets = np.zeros((count, 3)), np.zeros(count)
    alive = np.zeros(count, np.int64)
    present = 0
    removed = np.zeros(count, np.bool_)
    removed[vertices] = True
    for v in range(count):
        if not removed[v]:
            alive[present] = v
            present += 1
    for _ in range(20):
        _sweep(sphere, twin, origin, outgoing, areas, alive[:present], ring, star, points, targets,
               shape)  # fmt: skip
    for level in range(len(levels) - 1, 0, -1):
        for i in range(levels[level] - 1, levels[level - 1] - 1, -1):
            v = vertices[i]
            split(twin, origin, outgoing, v, spokes[i])
            degree = gather_ring(twin, origin, outgoing[v], ring, star)
            for k in range(degree):
                areas[star[k] // 3] = star_areas[offsets[i] + k]
                targets[k] = areas[star[k] // 3]
                points[k] = sphere[ring[k]]
            if not _insert(sphere[v], points, targets, degree, shape):
                return v
            alive[present] = v
            present += 1
        for _ in range(sweeps if present > 200 else 4 * sweeps):
            _sweep(sphere, twin, origin, outgoing, areas, alive[:present], ring, star, points,
                   targets, shape)  # fmt: skip
    return -1


@compiled
def _sweep(  # type: ignore[no-untyped-def]
    sphere, twin, origin, outgoing, areas, alive, ring, star, points, targets, shape
):
    """One Gauss-Seidel pass: every vertex in turn goes down the energy of its star."""
    for v in alive:
        degree = gather_ring(twin, origin, outgoing[v], ring, star)
        for k in range(degree):
            targets[k] = areas[star[k] // 3]
            points[k] = sphere[ring[k]]
        descend(sphere[v], points, targets, degree, shape, 2)


@compiled
def _insert(p, ring, targets, degree, shape):  # type: ignore[no-untyped-def]
    """Place a new vertex inside its star, of which ``ring[0]`` sees every edge.

    Candidates are the ring's centre and points along the bisector of the kernel's wedge at
    ``ring[0]``, which lies in the kernel near its tip whatever the angle there.
    """
    trial, best = np.zeros(3), np.zeros(3)
    least = np.inf
    for c in range(3):
        trial[c] = ring[:degree, c].mean()
    norm = np.sqrt((trial**2).sum())
    if norm > 0:
        trial /= norm
        least, _ = star_energy(trial, ring, targets, degree, shape)
        best[:] = trial
    bisector = _bisector(ring, degree)
    t = 1.0
    for _ in range(48):
        trial[:] = ring[0] + t * bisector
        trial /= np.sqrt((trial**2).sum())
        energy, _ = star_energy(trial, ring, targets, degree, shape)
        if energy < least:
            least = energy
            best[:] = trial
        t *= 0.6
    if least == np.inf:
        return False
    p[:] = best
    descend(p, ring, targets, degree, shape, 20)
    return True


@compiled
def _bisector(ring, degree):  # type: ignore[no-untyped-def]
    """Return the unit tangent at ``ring[0]`` halfway between its two edges in the ring."""
    u = ring[0]
    angle = 0.0
    first = ring[1] - u * (ring[1] * u).sum()
    first /= np.sqrt((first**2).sum())
    previous = first
    for k in range(2, degree):
        ray = ring[k] - u * (ring[k] * u).sum()
        ray /= np.sqrt((ray**2).sum())
        angle += np.arccos(min(1.0, max(-1.0, (previous * ray).sum())))
        previous = ray
    normal = np.array(
        (
            u[1] * first[2] - u[2] * first[1],
            u[2] * first[0] - u[0] * first[2],
            u[0] * first[1] - u[1] * first[0],
        )
    )
    return np.cos(angle / 2) * first + np.sin(angle / 2) * normal
