"""Wave kernel signature: single modes, the sphere, invariances."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from pydantic import ValidationError
from scipy.spatial.transform import Rotation

from gipkg.descriptors.operators import Operators
from gipkg.descriptors.wks import WaveKernelSignature
from gipkg.errors import UnsupportedMesh
from gipkg.testing import meshes


def signature(mesh: trimesh.Trimesh, **parameters: object) -> np.ndarray:
    return WaveKernelSignature(**parameters).describe(mesh, Operators(mesh))


def test_a_narrow_band_shows_one_mode() -> None:
    mesh = meshes.limbed()
    operators = Operators(mesh)
    spectrum, area = operators.spectrum, operators.mass.sum()
    gaps = np.diff(np.log(spectrum.eigenvalues[1:]))
    alone = 2 + np.flatnonzero(np.minimum(gaps[:-1], gaps[1:]) > 0.06)
    assert len(alone) > 3
    for k in alone:
        energy = spectrum.eigenvalues[k] * area
        narrow = WaveKernelSignature(energies=1, lowest=energy, highest=energy, width=0.01)
        found = narrow.describe(mesh, operators)
        assert_allclose(found[:, 0], area * spectrum.eigenvectors[:, k] ** 2, atol=1e-6)


def test_the_mean_over_a_surface_is_one(pebble) -> None:
    operators = Operators(pebble)
    values = WaveKernelSignature().describe(pebble, operators)
    assert values.min() >= 0
    assert_allclose(operators.mass @ values / operators.mass.sum(), 1, rtol=1e-9)


def test_it_nears_one_everywhere_on_a_sphere_as_the_mesh_is_refined() -> None:
    """By the addition theorem the squared harmonics of one degree have a constant sum."""
    errors = [
        np.abs(signature(trimesh.creation.icosphere(s), highest=300) - 1).max() for s in (2, 3, 4)
    ]
    assert errors[-1] < 0.04
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_energies_far_from_all_modes_take_the_nearest(small_pebble) -> None:
    low, high = signature(small_pebble, energies=2, lowest=1e-6, highest=1e9, width=0.05).T
    spectrum = Operators(small_pebble).spectrum
    area = spectrum.mass.sum()
    assert_allclose(low, area * spectrum.eigenvectors[:, 1] ** 2, rtol=1e-6, atol=1e-9)
    assert np.isfinite(high).all()


@settings(max_examples=5)
@given(seed=st.integers(0, 10**6), exponent=st.floats(-4, 4))
def test_motion_scale_and_numbering_do_not_matter(pebble, seed: int, exponent: float) -> None:
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(pebble.vertices))
    turned = Rotation.from_quat(rng.standard_normal(4)).apply(pebble.vertices)
    moved = (turned + rng.standard_normal(3)) * 10**exponent
    other = trimesh.Trimesh(moved[order], np.argsort(order)[pebble.faces], process=False)
    assert_allclose(signature(other), signature(pebble)[order], atol=1e-6)


@pytest.mark.parametrize(
    "parameters", [{"energies": 0}, {"lowest": 0}, {"lowest": 2, "highest": 1}, {"width": 0}]
)
def test_parameters_out_of_bounds_are_refused(parameters: dict) -> None:
    with pytest.raises(ValidationError):
        WaveKernelSignature(**parameters)


def test_a_constant_alone_is_no_wave(pebble) -> None:
    # The last eigenspace may not be whole, so that of two eigenpairs the constant is left.
    with pytest.raises(UnsupportedMesh, match="compute more eigenpairs"):
        WaveKernelSignature().describe(pebble, Operators(pebble, 2))
