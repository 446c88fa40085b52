"""Faces with next to no area: needles collapsed, flat corners flipped, the rest nudged."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces import halfedges
from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import DEGENERATE, repeats_vertex

SLIVER = 1e-7
"""A face below this share of the mean area is resolved; well above what validation refuses."""

NEEDLE = 1e-3
"""A sliver whose shortest edge is below this share of its longest is collapsed, others flip."""

ROUNDS = 20
"""Collapsing and flipping stop here at the latest: flips among slivers could go in circles."""

NUDGES = (1e-6, 1e-5, 1e-4, 1e-3)
"""Displacements, in mean edge lengths, tried in turn on faces that nothing else resolved."""


@dataclass(frozen=True, slots=True)
class Resolved:
    """How many slivers went by each way."""

    collapsed: int = 0
    flipped: int = 0
    nudged: int = 0


def resolve_slivers(mesh: Triangles) -> tuple[Triangles, Resolved]:
    """Remove the faces without area from a closed manifold surface; its topology stays."""
    collapsed = flipped = 0
    for _ in range(ROUNDS):
        area = face_areas(mesh.vertices, mesh.faces)
        slivers = np.flatnonzero(area <= SLIVER * area.mean())
        if not len(slivers):
            break
        edit = _Round(mesh)
        for face in slivers[np.argsort(area[slivers], kind="stable")].tolist():
            edit.resolve(face)
        if not edit.collapsed + edit.flipped:
            break
        collapsed += edit.collapsed
        flipped += edit.flipped
        mesh = edit.result()
    mesh, nudged = _nudge(mesh)
    return mesh, Resolved(collapsed, flipped, nudged)


class _Round:
    """Edits that do not touch each other, looked up in the mesh as it was before the round."""

    def __init__(self, mesh: Triangles) -> None:
        self.mesh = mesh
        self.faces = mesh.faces.copy()
        self.twin = halfedges.twins(mesh.faces)
        self.start, self.corners = halfedges.corners_by_vertex(mesh.faces, len(mesh.vertices))
        self.locked: set[int] = set()
        self.collapsed = self.flipped = 0

    def resolve(self, face: int) -> None:
        """Collapse or flip one sliver, unless an edit of this round lies next to it."""
        corners = self.mesh.faces[face]
        points = self.mesh.vertices[corners]
        length = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
        shortest, longest = int(np.argmin(length)), int(np.argmax(length))
        if length[shortest] <= NEEDLE * length[longest]:
            self._collapse(int(corners[shortest]), int(corners[(shortest + 1) % 3]))
        else:
            self._flip(3 * face + longest)

    def result(self) -> Triangles:
        """Return the edited mesh."""
        return self.mesh.with_faces(self.faces[~repeats_vertex(self.faces)]).compact()

    def _star(self, vertex: int) -> tuple[NDArray[np.int64], set[int]]:
        """Return the faces at a vertex and the vertices beside it."""
        faces = self.corners[self.start[vertex] : self.start[vertex + 1]] // 3
        return faces, set(self.mesh.faces[faces].ravel().tolist()) - {vertex}

    def _collapse(self, one: int, two: int) -> None:
        """Draw an edge together where its ends share no neighbours but the two opposite it."""
        gone, kept = (one, two) if self.mesh.original[two] else (two, one)
        faces, around_gone = self._star(gone)
        _, around_kept = self._star(kept)
        touched = around_gone | around_kept
        if touched & self.locked or len(around_gone & around_kept) != 2 or len(touched) < 5:
            return
        self.faces[faces] = np.where(self.faces[faces] == gone, kept, self.faces[faces])
        self.locked |= touched
        self.collapsed += 1

    def _flip(self, halfedge: int) -> None:
        """Turn the edge between two faces where that makes the smaller of them larger."""
        face, other = halfedge // 3, int(self.twin[halfedge]) // 3
        a, b, c = np.roll(self.mesh.faces[face], -(halfedge % 3)).tolist()
        d = int(self.mesh.faces[other].sum()) - a - b
        _, around = self._star(c)
        if {a, b, c, d} & self.locked or d in around:
            return
        flipped = np.array([[c, a, d], [d, b, c]])
        old = face_areas(self.mesh.vertices, self.mesh.faces[[face, other]])
        if face_areas(self.mesh.vertices, flipped).min() <= old.min():
            return
        self.faces[[face, other]] = flipped
        self.locked |= {a, b, c, d}
        self.flipped += 1


def _nudge(mesh: Triangles) -> tuple[Triangles, int]:
    """Displace the corners of faces without area, and count those faces."""
    random = np.random.default_rng(0)
    count = 0
    for scale in NUDGES:
        area = face_areas(mesh.vertices, mesh.faces)
        flat = area <= 2 * DEGENERATE * area.mean()
        if not flat.any():
            break
        count = max(count, int(np.count_nonzero(flat)))
        corners = np.unique(mesh.faces[flat])
        origin, target = halfedges.endpoints(mesh.faces)
        edge = np.linalg.norm(mesh.vertices[target] - mesh.vertices[origin], axis=1).mean()
        direction = random.standard_normal((len(corners), 3))
        vertices = mesh.vertices.copy()
        vertices[corners] += scale * edge * direction
        mesh = replace(mesh, vertices=vertices)
    return mesh, count
