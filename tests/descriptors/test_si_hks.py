"""Scale-invariant heat kernel signature: the sphere's series, and what a change of scale does."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose
from pydantic import ValidationError

from gipkg.descriptors.modes import modes_at_unit_area
from gipkg.descriptors.operators import Operators
from gipkg.descriptors.si_hks import ScaleInvariantHKS

WHOLE = {"shortest": 2.0**-14, "octaves": 18}
"""Times from before the first decay of any of 120 modes to after the last."""


def test_it_is_that_of_the_spheres_series() -> None:
    mesh = trimesh.creation.icosphere(4)
    descriptor = ScaleInvariantHKS(frequencies=4)
    degree = np.arange(60)[:, None]
    times = 2.0 ** (-7 + np.arange(161) / 16)
    series = ((2 * degree + 1) * np.exp(-4 * np.pi * degree * (degree + 1) * times)).sum(axis=0)
    expected = np.abs(np.fft.fft(np.diff(np.log(series))))[:4]
    values = descriptor.describe(mesh, Operators(mesh))
    assert_allclose(values, np.tile(expected, (len(values), 1)), rtol=0.02)


@pytest.mark.parametrize("octaves_of_shift", [0.5, 1.0])
def test_times_that_see_the_whole_decay_forget_the_scale(pebble, octaves_of_shift: float) -> None:
    """A surface larger by β is the same surface seen at times smaller by β²."""
    operators = Operators(pebble)
    values = ScaleInvariantHKS(**WHOLE).describe(pebble, operators)
    later = {**WHOLE, "shortest": WHOLE["shortest"] * 2**octaves_of_shift}
    shifted = ScaleInvariantHKS(**later).describe(pebble, operators)
    assert_allclose(shifted[:, 1:], values[:, 1:], atol=0.1)
    # The phases that it drops do not stay.
    assert np.ptp(values, axis=0)[1:4].min() > 0.3


def test_the_lowest_frequency_is_the_whole_decay(pebble) -> None:
    operators = Operators(pebble)
    values = ScaleInvariantHKS(**WHOLE).describe(pebble, operators)
    eigenvalues, squares = modes_at_unit_area(operators.spectrum)
    start = squares @ np.exp(-eigenvalues * 2.0**-14)
    assert_allclose(values[:, 0], np.log(start), atol=1e-6)


def test_motion_and_size_change_nothing(pebble) -> None:
    other = trimesh.Trimesh(1e3 * pebble.vertices[:, [1, 2, 0]] + 7.0, pebble.faces, process=False)
    descriptor = ScaleInvariantHKS()
    assert_allclose(
        descriptor.describe(other, Operators(other)),
        descriptor.describe(pebble, Operators(pebble)),
        atol=1e-6,
    )


@pytest.mark.parametrize(
    "parameters",
    [{"frequencies": 0}, {"shortest": 0}, {"frequencies": 32, "octaves": 4, "steps_per_octave": 2}],
)
def test_parameters_out_of_bounds_are_refused(parameters: dict) -> None:
    with pytest.raises(ValidationError):
        ScaleInvariantHKS(**parameters)
