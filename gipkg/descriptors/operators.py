"""What descriptors and baselines share of a mesh: Laplacian, mass, eigenpairs, mask."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg
import scipy.sparse as sp
import scipy.sparse.linalg
import trimesh
from numpy.typing import NDArray

from gipkg.descriptors.laplacian import barycentric_mass, cotangent_laplacian, edge_lengths
from gipkg.errors import UnsupportedMesh

DENSE_VERTICES = 500
"""Up to here the dense eigensolver is faster than shift-invert Lanczos at 120 eigenpairs."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The lower end of the Laplace-Beltrami spectrum.

    Attributes
    ----------
    eigenvalues : (k,) float64 array
        Ascending, none negative, the first exactly 0; in units of 1 / area.
    eigenvectors : (V, k) float64 array
        Orthonormal with respect to the mass: ``Φᵀ diag(mass) Φ = I``. Of the two signs, the
        one that makes the entry of largest magnitude positive (the first of several).
    mass : (V,) float64 array
        Barycentric vertex areas; they sum to the surface area.
    """

    eigenvalues: NDArray[np.float64]
    eigenvectors: NDArray[np.float64]
    mass: NDArray[np.float64]


class Operators:
    """Laplacian, mass and eigenpairs of one mesh, each computed at first use and kept.

    `mesh` and `mask` are as they were given.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        V vertices, every one of them in a face; never changed.
    eigenpairs : int
        How many to compute; at most V - 1 are.
    spectrum : Spectrum, optional
        Known already, for example from a file; then no eigenproblem is solved.
    mask : (V,) bool array, optional
        The topological mask of a prepared surface: False at the vertices of what was added to
        close it. By default nothing was.

    Raises
    ------
    UnsupportedMesh
        At construction if `spectrum` or `mask` is of a mesh with another number of vertices, at
        first use if coordinates are not finite or a vertex is in no face.
    """

    def __init__(
        self,
        mesh: trimesh.Trimesh,
        eigenpairs: int = 120,
        spectrum: Spectrum | None = None,
        mask: NDArray[np.bool_] | None = None,
    ) -> None:
        vertices = len(mesh.vertices)
        mass = None if spectrum is None else spectrum.mass
        for name, known in (("spectrum", mass), ("mask", mask)):
            if known is not None and len(known) != vertices:
                raise UnsupportedMesh(
                    f"the {name} given is of a mesh with {len(known)} vertices, "
                    f"this one has {vertices}: compute it anew from this mesh"
                )
        self.mesh = mesh
        self.mask = np.ones(vertices, dtype=bool) if mask is None else mask
        self._eigenpairs = eigenpairs
        self._known = spectrum

    @cached_property
    def _lengths(self) -> NDArray[np.float64]:
        if not np.isfinite(self.mesh.vertices).all():
            raise UnsupportedMesh(
                "the mesh has non-finite coordinates: read it with gipkg.prepare, which names them"
            )
        return edge_lengths(self.mesh)

    @cached_property
    def laplacian(self) -> sp.csr_array:
        """(V, V) positive semidefinite cotangent stiffness matrix."""
        return cotangent_laplacian(self.mesh, self._lengths)

    @cached_property
    def mass(self) -> NDArray[np.float64]:
        """(V,) barycentric lumped vertex areas."""
        if self._known is not None:
            return self._known.mass
        mass = barycentric_mass(self.mesh, self._lengths)
        if not mass.all():
            raise UnsupportedMesh(
                f"vertex {int(np.argmin(mass))} has no area: remove unreferenced vertices "
                "(gipkg.prepare does)"
            )
        return mass

    @cached_property
    def spectrum(self) -> Spectrum:
        """The smallest eigenpairs of the generalised problem L φ = λ M φ."""
        if self._known is not None:
            return self._known
        return _solve(self.laplacian, self.mass, self._eigenpairs)


def _solve(laplacian: sp.csr_array, mass: NDArray[np.float64], eigenpairs: int) -> Spectrum:
    """Solve through the symmetric M^-½ L M^-½, scaled to unit area for a scale-free solver."""
    vertices = len(mass)
    k = min(eigenpairs, vertices - 1)
    area = mass.sum()
    root = np.sqrt(mass / area)
    scaling = sp.diags_array(1 / root)
    operator = (scaling @ laplacian @ scaling).tocsc()
    if vertices <= max(DENSE_VERTICES, 2 * k):
        values, vectors = scipy.linalg.eigh(operator.toarray(), driver="evd", check_finite=False)
        values, vectors = values[:k], vectors[:, :k]
    else:
        # The shift makes the operator definite; the fixed start makes the result repeatable.
        start = np.random.default_rng(0).standard_normal(vertices)
        values, vectors = scipy.sparse.linalg.eigsh(
            operator, k, sigma=-1.0, v0=start, ncv=3 * k // 2 + 20
        )
        order = np.argsort(values, kind="stable")
        values, vectors = values[order], vectors[:, order]
    vectors = vectors / (root * np.sqrt(area))[:, None]
    vectors *= _signs(vectors)
    values = np.maximum(values, 0.0) / area
    values[0] = 0.0
    return Spectrum(values, vectors, mass)


def _signs(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Signs (k,) of the first entries about as large as any; symmetric shapes have several."""
    sizes = np.abs(vectors)
    first = (sizes > 0.99 * sizes.max(axis=0)).argmax(axis=0)
    return np.sign(vectors[first, np.arange(vectors.shape[1])])
