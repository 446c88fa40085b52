"""Green's mean signature: the sphere's series, Green's function, the heat kernel's moments."""

from __future__ import annotations

from math import gamma

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose
from pydantic import ValidationError
from scipy.integrate import quad

from gipkg.descriptors import describe
from gipkg.descriptors.gms import GreensMeanSignature
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh

RAW = {"logarithm": False}


def test_it_is_the_spheres_series() -> None:
    """Unit area: g_p = Σ (2l + 1) (4π l (l + 1))^-p over l ≥ 1, the same at every point."""
    mesh = trimesh.creation.icosphere(4, radius=0.1)
    # Eigenvalues up to l = 9 are 99 of the 120, and the last eigenspace is not whole.
    degree = np.arange(1, 10)[:, None]
    moments = np.array([2.0, 3.0])
    series = ((2 * degree + 1) * (4 * np.pi * degree * (degree + 1.0)) ** -moments).sum(axis=0)
    found = describe(mesh, "gms", Operators(mesh, 101), moments=tuple(moments), **RAW)
    assert_allclose(found, np.tile(series, (len(found), 1)), rtol=0.02)


def test_its_first_moment_is_the_squared_length_of_the_global_point_signature(pebble) -> None:
    operators = Operators(pebble, 60)
    signature = describe(pebble, "gps", operators, modes=58)
    found = describe(pebble, "gms", operators, moments=(1.0,), **RAW)
    assert_allclose(found[:, 0], (signature**2).sum(axis=1), rtol=1e-9)


def test_it_is_the_heat_kernel_averaged_over_all_times(small_pebble) -> None:
    operators = Operators(small_pebble, 30)
    for moment in (1.5, 2.0):
        found = describe(small_pebble, "gms", operators, moments=(moment,), **RAW)[:3, 0]

        def weighted(time: float, vertex: int, moment: float = moment) -> float:
            same = {"times": 1, "shortest": time, "longest": time, **RAW}
            heat = describe(small_pebble, "hks", operators, **same)[vertex, 0]
            return (heat - 1) * time ** (moment - 1) / gamma(moment)

        expected = [
            quad(weighted, 1e-12, 0.2, args=(v,))[0] + quad(weighted, 0.2, 5, args=(v,))[0]
            for v in range(3)
        ]
        assert_allclose(found, expected, rtol=1e-4)


def test_channels_are_named_by_their_power_and_the_logarithm_is_one(pebble) -> None:
    descriptor = GreensMeanSignature(moments=(1.5, 2))
    assert descriptor.channels() == ("log-gms-1.5", "log-gms-2")
    raw = describe(pebble, "gms", moments=(1.5, 2), **RAW)
    assert_allclose(descriptor.describe(pebble, Operators(pebble)), np.log(raw))
    with pytest.raises(ValidationError):
        GreensMeanSignature(moments=())


def test_a_constant_alone_is_no_wave(pebble) -> None:
    with pytest.raises(UnsupportedMesh, match="compute more eigenpairs"):
        describe(pebble, "gms", Operators(pebble, 2))
