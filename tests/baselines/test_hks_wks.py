from __future__ import annotations

import numpy as np
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from gipkg.baselines.hks_wks import SignatureQuantiles, weighted_quantiles
from gipkg.descriptors.operators import Operators


@given(st.integers(0, 10**6), st.integers(1, 30))
def test_equal_weights_give_the_quantiles_of_numpy(seed: int, count: int) -> None:
    values = np.random.default_rng(seed).integers(-3, 3, (count, 2)).astype(float)
    levels = np.linspace(0, 1, 7)
    expected = np.quantile(values, levels, axis=0, method="hazen").T
    assert_allclose(weighted_quantiles(values, np.full(count, 0.3), levels), expected, atol=1e-12)


def test_weights_count_as_so_many_values() -> None:
    rng = np.random.default_rng(0)
    values, weights = rng.standard_normal((300, 1)), rng.integers(1, 5, 300)
    repeated = np.repeat(values, weights, axis=0)
    levels = np.linspace(0.05, 0.95, 10)
    expected = np.quantile(repeated, levels, axis=0).T
    assert_allclose(weighted_quantiles(values, weights.astype(float), levels), expected, atol=0.03)


def test_the_length_is_that_of_the_parameters_and_a_sphere_has_one_value_a_channel() -> None:
    mesh = trimesh.creation.icosphere(4)
    found = SignatureQuantiles(times=3, energies=4, levels=5).represent(mesh, Operators(mesh))
    assert found.shape == (35,)
    assert np.ptp(found.reshape(7, 5), axis=1).max() < 0.05


def test_vertices_count_by_their_area() -> None:
    """Half of a sphere is meshed more finely; an unweighted quantile would see little else."""
    coarse = trimesh.creation.icosphere(3)
    coarse.vertices *= [1.0, 1.5, 3.0]
    upper = np.flatnonzero(coarse.triangles_center[:, 2] > 0)
    vertices, faces = trimesh.remesh.subdivide(coarse.vertices, coarse.faces, upper)
    fine = trimesh.Trimesh(vertices, faces)
    one, other = (SignatureQuantiles().represent(mesh, Operators(mesh)) for mesh in (coarse, fine))
    assert len(fine.vertices) > 1.8 * len(coarse.vertices)
    assert np.abs(one - other).max() < 0.1 * np.ptp(one)
