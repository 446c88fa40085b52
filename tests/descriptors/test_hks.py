"""Heat kernel signature: the sphere's series, the heat operator, invariances."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from pydantic import ValidationError
from scipy.spatial.transform import Rotation

from gipkg.descriptors import describe
from gipkg.descriptors.hks import HeatKernelSignature
from gipkg.descriptors.operators import Operators


def signature(mesh: trimesh.Trimesh, **parameters: object) -> np.ndarray:
    return HeatKernelSignature(**parameters).describe(mesh, Operators(mesh))


def test_it_nears_the_spheres_series_as_the_mesh_is_refined() -> None:
    """Unit area: h_t = Σ (2l + 1) exp(-4π l (l + 1) t), the same at every point."""
    descriptor = HeatKernelSignature(times=6, shortest=0.01, longest=0.3, logarithm=False)
    degree = np.arange(60)[:, None]
    times = descriptor.schedule()
    series = ((2 * degree + 1) * np.exp(-4 * np.pi * degree * (degree + 1) * times)).sum(axis=0)
    errors = []
    for subdivisions in (2, 3, 4):
        mesh = trimesh.creation.icosphere(subdivisions)
        values = descriptor.describe(mesh, Operators(mesh))
        errors.append(np.abs(values / series - 1).max())
    assert errors[-1] < 0.012
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_it_is_the_diagonal_of_the_heat_operator(small_pebble) -> None:
    """Second route: exp(-t M⁻¹ L) M⁻¹ by scaling and squaring, without eigenpairs."""
    operators = Operators(small_pebble, eigenpairs=161)
    descriptor = HeatKernelSignature(times=4, shortest=0.03, longest=1, logarithm=False)
    values = descriptor.describe(small_pebble, operators)
    area = small_pebble.area
    generator = operators.laplacian.toarray() / operators.mass[:, None]
    for time, column in zip(descriptor.schedule(), values.T, strict=True):
        kernel = scipy.linalg.expm(-time * area * generator) / operators.mass
        assert_allclose(column, area * kernel.diagonal(), rtol=1e-9)


@settings(max_examples=5)
@given(seed=st.integers(0, 10**6), exponent=st.floats(-4, 4))
def test_motion_scale_and_numbering_do_not_matter(pebble, seed: int, exponent: float) -> None:
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(pebble.vertices))
    turned = Rotation.from_quat(rng.standard_normal(4)).apply(pebble.vertices)
    moved = (turned + rng.standard_normal(3)) * 10**exponent
    other = trimesh.Trimesh(moved[order], np.argsort(order)[pebble.faces], process=False)
    assert_allclose(signature(other), signature(pebble)[order], atol=1e-6)


def test_symmetric_points_have_equal_signatures_despite_repeated_eigenvalues() -> None:
    """The icosphere has eigenspaces of up to 5 dimensions, and 120 cuts one in two."""
    mesh = trimesh.creation.icosphere(3)
    values = signature(mesh)
    centres = np.flatnonzero(mesh.vertex_degree == 5)
    assert len(centres) == 12
    assert np.ptp(values[centres], axis=0).max() < 1e-9


def test_an_eigenspace_that_the_truncation_cuts_is_left_out() -> None:
    mesh = trimesh.creation.icosphere(2)
    spectrum = Operators(mesh, eigenpairs=3).spectrum  # the first triplet, one short
    assert spectrum.eigenvalues[1] == pytest.approx(spectrum.eigenvalues[2])
    assert_allclose(signature_of(mesh, 3), 1, atol=1e-9)
    assert_allclose(signature_of(mesh, 5), signature_of(mesh, 6), atol=1e-9)


def signature_of(mesh: trimesh.Trimesh, eigenpairs: int) -> np.ndarray:
    return HeatKernelSignature(logarithm=False).describe(mesh, Operators(mesh, eigenpairs))


def test_an_articulated_limb_keeps_its_signature() -> None:
    """Bending a thin strip by half a turn is an isometry, up to the mesh."""
    strip = trimesh.creation.box((8, 1, 0.1)).subdivide_to_size(0.25)
    x, y, z = strip.vertices.T
    radius = 8 / np.pi
    bent = np.column_stack(
        [(radius + z) * np.sin(x / radius), y, (radius + z) * np.cos(x / radius)]
    )
    other = trimesh.Trimesh(bent, strip.faces, process=False)
    assert_allclose(signature(other), signature(strip), atol=0.03)
    assert np.ptp(signature(strip), axis=0).min() > 0.3


def test_logarithm_and_raw_are_the_same_numbers(pebble) -> None:
    logarithm, raw = signature(pebble), signature(pebble, logarithm=False)
    assert raw.min() >= 1
    assert_allclose(np.exp(logarithm), raw, rtol=1e-14)
    assert (np.diff(raw, axis=1) < 0).all()


def test_channels_are_named_by_their_times() -> None:
    assert HeatKernelSignature(times=3, shortest=0.01, longest=1).channels() == (
        "log-hks-0.01",
        "log-hks-0.1",
        "log-hks-1",
    )
    assert HeatKernelSignature(times=1, logarithm=False).channels() == ("hks-0.007",)


def test_describe_finds_the_descriptor_by_name(pebble) -> None:
    operators = Operators(pebble)
    values = describe(pebble, "hks", operators, times=7)
    assert_array_equal(values, HeatKernelSignature(times=7).describe(pebble, operators))
    assert_allclose(describe(pebble), signature(pebble), atol=1e-12)


@pytest.mark.parametrize(
    "parameters", [{"times": 0}, {"shortest": 0}, {"shortest": 2, "longest": 1}, {"scale": 1}]
)
def test_parameters_out_of_bounds_are_refused(parameters: dict) -> None:
    with pytest.raises(ValidationError):
        HeatKernelSignature(**parameters)
