import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gipkg.parametrizers.sphere.area_residual import area_residual

RATIOS = st.floats(-12, 12).map(np.exp)


@given(RATIOS)
def test_the_slope_is_that_of_the_residual(ratio: float) -> None:
    step = 1e-5 * ratio
    numeric = (area_residual(ratio + step)[0] - area_residual(ratio - step)[0]) / (2 * step)
    assert area_residual(ratio)[1] == pytest.approx(numeric, rel=1e-4)


@given(RATIOS)
@example(1 + 2**-52)
@example(1 - 2**-53)
def test_it_has_the_sign_of_the_error_and_grows(ratio: float) -> None:
    residual, slope = area_residual(ratio)
    assert np.sign(residual) == np.sign(ratio - 1)
    assert slope > 0


def test_both_branches_meet_to_second_order() -> None:
    step = 1e-4
    below, above = area_residual(1 - step), area_residual(1 + step)
    assert area_residual(1.0) == (0, 1)
    # r - 1 - (r - 1)² / 2 on both sides, up to a cubic remainder.
    assert below[0] == pytest.approx(-step - step**2 / 2, abs=step**3)
    assert above[0] == pytest.approx(step - step**2 / 2, abs=step**3)
    assert below[1] == pytest.approx(1 + step, abs=2 * step**2)
    assert above[1] == pytest.approx(1 - step, abs=2 * step**2)


def test_large_faces_pay_in_proportion_and_small_ones_without_bound() -> None:
    assert area_residual(1000.0)[0] ** 2 == pytest.approx(1000, rel=0.01)
    assert area_residual(1e-300)[0] < -600
