"""Global point signature: Green's function, the sphere, signs."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
import trimesh
from numpy.testing import assert_allclose

from gipkg.descriptors import describe
from gipkg.descriptors.operators import Operators, Spectrum
from gipkg.errors import UnsupportedMesh


def test_inner_products_are_greens_function() -> None:
    """Second route: the pseudo-inverse of the Laplacian, without eigenpairs."""
    mesh = trimesh.creation.icosphere(1)
    mesh.apply_transform(np.diag([1.0, 1.3, 1.7, 1.0]))
    base = Operators(mesh)
    eigenpairs = scipy.linalg.eigh(base.laplacian.toarray(), np.diag(base.mass))
    operators = Operators(mesh, spectrum=Spectrum(*eigenpairs, base.mass))
    signature = describe(mesh, "gps", operators, modes=41, magnitude=False)
    root = np.sqrt(operators.mass)
    scaled = operators.laplacian.toarray() / np.outer(root, root)
    # G M is a pure number, and so is G at unit area on a surface.
    green = np.linalg.pinv(scaled, rcond=1e-10) / np.outer(root, root)
    assert_allclose(signature @ signature.T, green, atol=1e-9)


def test_the_first_modes_of_a_sphere_together_are_the_same_everywhere() -> None:
    """λ = 2 three times, and Σ φ² = 3 / 4π: at any size Σ gps² = 3 / 8π."""
    mesh = trimesh.creation.icosphere(4, radius=7.0)
    signature = describe(mesh, "gps", modes=3)
    assert_allclose((signature**2).sum(axis=1), 3 / (8 * np.pi), rtol=0.01)


def test_magnitudes_are_those_of_the_signed_values(pebble) -> None:
    signed = describe(pebble, "gps", magnitude=False)
    assert signed.min() < 0
    assert_allclose(describe(pebble, "gps"), np.abs(signed))


def test_too_few_modes_are_named() -> None:
    with pytest.raises(UnsupportedMesh, match="100 modes are asked for and 10 are known"):
        describe(trimesh.creation.icosahedron(), "gps", modes=100)
