"""What curvature a triangle mesh has, edge by edge and vertex by vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
import trimesh
from numpy.typing import NDArray

from gipkg.descriptors.vertex_normals import vertex_normals
from gipkg.errors import UnsupportedMesh


@dataclass(frozen=True, slots=True)
class Measures:
    """Integrals of curvature around the vertices.

    Attributes
    ----------
    gaussian : (V,) float64 array
        Angle defects; they sum to 2π times the Euler number.
    mean : (V,) float64 array
        Half of the integral of the mean curvature over the edges at a vertex, the other half
        being its other end's.
    anisotropic : (V,) complex128 array
        The same of half the difference of the principal curvatures, with twice the angle of the
        direction of the smaller one in the tangent frame of the vertex as its phase.
    vertices : (V, 3) float64 array
    frames : (V, 2, 3) float64 array
        Orthonormal tangents of each vertex.
    """

    gaussian: NDArray[np.float64]
    mean: NDArray[np.float64]
    anisotropic: NDArray[np.complex128]
    vertices: NDArray[np.float64]
    frames: NDArray[np.float64]

    def turning_laplacian(self, laplacian: sp.csr_array) -> sp.csr_array:
        """Carry a scalar Laplacian over to quantities like `anisotropic`.

        An edge compares its ends after parallel transport: its own direction is the same at
        both (Knöppel, Crane, Pinkall & Schröder, "Globally Optimal Direction Fields", 2013).

        Returns
        -------
        (V, V) complex sparse array, Hermitian, positive semidefinite
        """
        upper = sp.triu(laplacian, 1).tocoo()
        i, j = upper.row, upper.col
        edges = self.vertices[j] - self.vertices[i]
        # With a negative weight the matrix would not be definite, unlike the scalar one.
        weights = np.maximum(-upper.data, 0.0)
        turns = _phase(edges, self.frames[i]) * _phase(edges, self.frames[j]).conj()
        half = sp.coo_array((weights * turns, (i, j)), shape=laplacian.shape)
        sizes = sum(np.bincount(end, weights, len(self.vertices)) for end in (i, j))
        return (sp.diags_array(sizes) - half - half.conj().T).tocsr()


def curvature_measures(mesh: trimesh.Trimesh) -> Measures:
    """Measure a closed mesh, oriented outwards (Cohen-Steiner & Morvan 2003).

    An edge of length l and exterior dihedral angle β, positive if convex, has β l of principal
    curvature across and none along itself.

    Raises
    ------
    UnsupportedMesh
        The mesh is not closed, or its faces are not oriented alike.
    """
    vertices = np.asarray(mesh.vertices, dtype=np.float64)
    faces = np.asarray(mesh.faces)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    frames = _frames(vertex_normals(vertices, faces))

    tails, heads, left, right = _edges(faces, len(vertices))
    edges = vertices[heads] - vertices[tails]
    lengths = np.linalg.norm(edges, axis=1)
    # atan2 needs no unit normals, and is exact for flat edges and folds alike.
    sines = np.einsum("ei,ei->e", np.cross(normals[left], normals[right]), edges)
    cosines = lengths * np.einsum("ei,ei->e", normals[left], normals[right])
    integrals = np.arctan2(sines, cosines) * lengths / 4

    mean = np.zeros(len(vertices), dtype=np.float64)
    anisotropic = np.zeros(len(vertices), dtype=complex)
    for end in (tails, heads):
        np.add.at(mean, end, integrals)
        np.add.at(anisotropic, end, integrals * _phase(edges, frames[end]))
    angles = np.bincount(faces.ravel(), _angles(corners).ravel(), len(vertices))
    gaussian = np.asarray(2 * np.pi - angles, dtype=np.float64)
    return Measures(gaussian, mean, anisotropic, vertices, frames)


def _edges(faces: NDArray[np.int64], vertices: int) -> tuple[NDArray[np.int64], ...]:
    """Return tail, head, left and right face (E,) of every edge of a closed oriented mesh."""
    tails, heads = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    face = np.repeat(np.arange(len(faces)), 3)
    ahead, back = tails * vertices + heads, heads * vertices + tails
    forward, backward = np.argsort(ahead), np.argsort(back)
    if not np.array_equal(ahead[forward], back[backward]):
        raise UnsupportedMesh(
            "curvature needs a closed mesh whose faces are oriented alike: gipkg.prepare makes one"
        )
    left, right = face[forward], face[backward]
    once = tails[forward] < heads[forward]
    return tails[forward][once], heads[forward][once], left[once], right[once]


def _frames(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return any orthonormal pair (V, 2, 3) across each normal; the choice cancels out."""
    across = np.eye(3)[np.abs(normals).argmin(axis=1)]
    first = np.cross(normals, across)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(normals, first)], axis=1)


def _phase(directions: NDArray[np.float64], frames: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return twice the angle of each direction in its frame, as a complex number of size 1."""
    x, y = np.einsum("eki,ei->ke", frames, directions)
    return np.exp(2j * np.arctan2(y, x))


def _angles(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the inner angles (F, 3) of triangles."""
    forward = np.roll(corners, -1, axis=1) - corners
    backward = np.roll(corners, 1, axis=1) - corners
    sines = np.linalg.norm(np.cross(forward, backward), axis=2)
    return np.arctan2(sines, np.einsum("fki,fki->fk", forward, backward))
