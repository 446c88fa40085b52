"""The state that the repair steps hand on."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import trimesh
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Triangles:
    """A triangle mesh under repair; steps return a new one.

    Attributes
    ----------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array
    original : (V,) bool array
        False at the vertices of what was added to close the surface.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    original: NDArray[np.bool_]

    @classmethod
    def of(cls, mesh: trimesh.Trimesh) -> Triangles:
        """Take over a mesh, all of it original."""
        vertices = np.asarray(mesh.vertices, np.float64)
        return cls(vertices, np.asarray(mesh.faces, np.int64), np.ones(len(vertices), bool))

    def with_faces(self, faces: NDArray[np.int64]) -> Triangles:
        """Return the same vertices under other faces."""
        return replace(self, faces=faces)

    def compact(self) -> Triangles:
        """Return the mesh without its unused vertices, in the same order."""
        used = np.zeros(len(self.vertices), bool)
        used[self.faces.ravel()] = True
        if used.all():
            return self
        number = np.cumsum(used) - 1
        return Triangles(self.vertices[used], number[self.faces], self.original[used])

    def append(self, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> Triangles:
        """Return the mesh with added (n, 3) vertices and (m, 3) faces that close it."""
        return Triangles(
            np.concatenate((self.vertices, vertices)),
            np.concatenate((self.faces, faces)),
            np.concatenate((self.original, np.zeros(len(vertices), bool))),
        )
