import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gipkg.parametrizers.variational.area_penalty import area_penalty, area_penalty_derivatives

RATIOS = st.floats(-12, 12).map(np.exp)


@given(RATIOS)
def test_the_slope_is_that_of_the_penalty(ratio: float) -> None:
    step = 1e-5 * ratio
    numeric = (area_penalty(ratio + step) - area_penalty(ratio - step)) / (2 * step)
    slope, _ = area_penalty_derivatives(ratio)
    assert slope == pytest.approx(numeric, rel=1e-4, abs=1e-4)


@given(RATIOS)
def test_the_curvature_is_gauss_newton_on_the_root(ratio: float) -> None:
    # φ = ρ², so that φ' = 2 ρ ρ' and the Gauss-Newton curvature is 2 ρ'² = φ'² / 2φ.
    slope, curvature = area_penalty_derivatives(ratio)
    value = area_penalty(ratio)
    if value > 1e-6:
        assert curvature == pytest.approx(slope**2 / (2 * value), rel=1e-6)


def test_both_branches_meet_and_large_faces_pay_in_proportion() -> None:
    below, above = np.nextafter(1, 0), np.nextafter(1, 2)
    assert area_penalty(below) == pytest.approx(area_penalty(above), abs=1e-15)
    assert area_penalty_derivatives(below)[1] == pytest.approx(2)
    assert area_penalty_derivatives(above)[1] == pytest.approx(2)
    assert area_penalty(1000.0) == pytest.approx(1000, rel=0.01)
    assert area_penalty(1e-300) < 1e6
