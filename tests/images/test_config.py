"""The images that a configuration asks for."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from pydantic import ValidationError

from gipkg.images.config import ImageConfig
from gipkg.images.cuts import standard_cuts, upright_cuts


def test_the_paper_s_cuts_are_the_default(sphere_map) -> None:
    cuts = ImageConfig().choose(sphere_map, "any")
    assert_array_equal(cuts.as_quat(), standard_cuts().as_quat())


def test_random_cuts_are_as_many_and_others_for_each_shape(sphere_map) -> None:
    config = ImageConfig(cuts="random")
    first, again, other = (config.choose(sphere_map, name).as_quat() for name in "aab")
    assert first.shape == standard_cuts().as_quat().shape
    assert_array_equal(first, again)
    assert np.abs(first - other).min() > 0


def test_the_pose_of_an_upright_shape_is_taken_or_forgotten(star_map) -> None:
    spherical_map = star_map(1, 60)
    posed = ImageConfig(cuts="upright", azimuth="pose", turns=4).choose(spherical_map, "a")
    assert_array_equal(posed.as_quat(), upright_cuts(spherical_map, 4).as_quat())
    unknown = ImageConfig(cuts="upright")
    begins = []
    for name in "abcdefgh":
        cuts = unknown.choose(spherical_map, name)
        assert_array_equal(cuts.as_quat(), unknown.choose(spherical_map, name).as_quat())
        turned = (cuts[0] * posed[0].inv()).as_rotvec()
        assert_allclose(turned[:2], 0, atol=1e-9)
        begins.append(turned[2])
    assert np.ptp(begins) > np.pi
    assert len(set(begins)) == 8


def test_what_is_not_known_is_refused() -> None:
    for wrong in ({"size": 2}, {"cuts": "any"}, {"turns": 0}, {"azimuth": 0.5}, {"cut": "upright"}):
        with pytest.raises(ValidationError):
            ImageConfig(**wrong)
