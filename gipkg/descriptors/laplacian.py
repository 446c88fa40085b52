"""The Laplace-Beltrami operator of a triangle mesh, from its edge lengths alone."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
import trimesh
from numpy.typing import NDArray

from gipkg.surfaces.areas import at_vertices

MOLLIFICATION = 1e-5
"""Slack that every triangle inequality gets, in units of the mean edge length."""


def edge_lengths(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Length of the edge opposite to each corner, with no degenerate triangle left.

    Where a needle or a collapsed face breaks the strict triangle inequality, all edges grow
    by one constant that restores it (intrinsic mollification: Sharp & Crane, "A Laplacian
    for Nonmanifold Triangle Meshes", SGP 2020, section 4.5). The operators built from the
    lengths stay exactly positive semidefinite, since the lengths are those of a real metric.

    Returns
    -------
    (F, 3) float64 array
    """
    corners = np.asarray(mesh.vertices, dtype=np.float64)[np.asarray(mesh.faces)]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1), axis=2)
    excess = 2 * lengths.max(axis=1) - lengths.sum(axis=1)
    return lengths + max(0.0, float(excess.max()) + MOLLIFICATION * float(lengths.mean()))


def heron_areas(lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Triangle areas (F,) from edge lengths (F, 3), by Kahan's stable form of Heron's formula."""
    c, b, a = np.sort(lengths, axis=1).T
    return np.sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))) / 4


def cotangent_laplacian(mesh: trimesh.Trimesh, lengths: NDArray[np.float64]) -> sp.csr_array:
    """Positive semidefinite stiffness matrix of linear finite elements.

    Off the diagonal it holds -(cot α + cot β) / 2 of the two angles that face an edge
    (Pinkall & Polthier, "Computing Discrete Minimal Surfaces and Their Conjugates",
    Experimental Mathematics 1993); rows sum to zero.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        V vertices and F faces; only the connectivity is read.
    lengths : (F, 3) float64 array
        From :func:`edge_lengths`.

    Returns
    -------
    (V, V) sparse array, symmetric
    """
    squares = lengths**2
    cotangents = (squares.sum(axis=1, keepdims=True) - 2 * squares) / (
        4 * heron_areas(lengths)[:, None]
    )
    faces = np.asarray(mesh.faces)
    tails, heads = np.roll(faces, -1, axis=1).ravel(), np.roll(faces, 1, axis=1).ravel()
    half = sp.coo_array((cotangents.ravel() / 2, (tails, heads)), shape=(len(mesh.vertices),) * 2)
    weights = (half + half.T).tocsr()
    return (sp.diags_array(weights.sum(axis=1)) - weights).tocsr()


def barycentric_mass(mesh: trimesh.Trimesh, lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lumped mass matrix's diagonal (V,): a third of the area of the faces around a vertex."""
    return at_vertices(heron_areas(lengths), np.asarray(mesh.faces), len(mesh.vertices))
