"""Piecewise linear functions on a closed triangle mesh: stiffness and gradients."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from gipkg.compilation import compiled


class LinearElements:
    """The linear finite elements of a closed triangle mesh in space.

    Parameters
    ----------
    points : (V, 3) float64 array
    faces : (F, 3) int64 array
        Every face has an area.

    Attributes
    ----------
    count : int
        Number of vertices V.
    faces : (F, 3) int64 array
    hats : (F, 3, 3) float64 array
        Gradient on each face of the function that is 1 at a corner and 0 at the two others.
    areas : (F,) float64 array
    angles : (F, 3) float64 array
        At the corners, in radians.
    """

    def __init__(self, points: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
        corners = points[faces]
        to_next = np.roll(corners, -1, axis=1) - corners
        to_previous = np.roll(corners, 1, axis=1) - corners
        normals = np.cross(to_next[:, 0], to_previous[:, 0])
        doubled = np.linalg.norm(normals, axis=1)
        opposite = to_previous - to_next
        self.count = len(points)
        self.faces = faces
        self.areas = doubled / 2
        self.hats = np.cross(normals[:, None], opposite) / doubled[:, None, None] ** 2
        self.angles = np.arctan2(doubled[:, None], np.einsum("fkc,fkc->fk", to_next, to_previous))

    def stiffness(self) -> sp.csr_array:
        """Positive semidefinite Laplacian (V, V): integrals of products of hat gradients.

        Off the diagonal these are minus half the sum of two cotangents; rows sum to zero.
        """
        blocks = np.einsum("f,fic,fjc->fij", self.areas, self.hats, self.hats)
        rows = np.repeat(self.faces, 3, axis=1).ravel()
        columns = np.tile(self.faces, (1, 3)).ravel()
        return sp.coo_array((blocks.ravel(), (rows, columns)), shape=(self.count,) * 2).tocsr()

    def vertex_gradients(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Gradients (V, 3) of a function (V,): the faces' ones, weighted by angle.

        Source: the paper, equation 4.
        """
        return _vertex_gradients(self.faces, self.hats, self.angles, values)


@compiled
def _vertex_gradients(faces, hats, angles, values):  # type: ignore[no-untyped-def]
    gradients = np.zeros((len(values), 3))
    weights = np.zeros(len(values))
    gradient = np.zeros(3)
    for f in range(len(faces)):
        i, j, k = faces[f]
        # Differences first: a constant has no gradient, whatever its size.
        for c in range(3):
            gradient[c] = (values[j] - values[i]) * hats[f, 1, c]
            gradient[c] += (values[k] - values[i]) * hats[f, 2, c]
        for corner in range(3):
            v = faces[f, corner]
            weights[v] += angles[f, corner]
            for c in range(3):
                gradients[v, c] += angles[f, corner] * gradient[c]
    for v in range(len(values)):
        for c in range(3):
            gradients[v, c] /= weights[v]
    return gradients
