"""Verdicts follow from the numbers alone."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gipkg.reporting.page.verdicts import Reason, Scale, Verdict, count, judge, reason_for

POINTS = Scale(1.0)
VARIANCE = Scale(0.25, relative=True, lower_is_better=True)


@pytest.mark.parametrize(
    ("ours", "printed", "spread", "scale", "expected"),
    [
        (89.6, 88.6, 0.0, POINTS, Verdict.MATCHES),
        (87.6, 88.6, 0.0, POINTS, Verdict.MATCHES),
        (89.7, 88.6, 0.0, POINTS, Verdict.BETTER),
        (87.5, 88.6, 0.0, POINTS, Verdict.DIFFERS),
        (87.5, 88.6, 0.6, POINTS, Verdict.MATCHES),
        (1.2e-7, 1e-7, 0.0, VARIANCE, Verdict.MATCHES),
        (1.3e-7, 1e-7, 0.0, VARIANCE, Verdict.DIFFERS),
        (7e-9, 1e-7, 0.0, VARIANCE, Verdict.BETTER),
        (None, 88.6, 0.0, POINTS, Verdict.NOT_IN_THIS_RUN),
        (88.6, None, 0.0, POINTS, Verdict.NOT_IN_THE_PAPER),
    ],
)
def test_a_value_is_judged_by_its_scale(
    ours: float | None, printed: float | None, spread: float, scale: Scale, expected: Verdict
) -> None:
    assert judge(ours, printed, spread, scale) == expected


@given(st.floats(0, 100), st.floats(0, 100), st.floats(0, 5))
def test_better_one_way_is_worse_the_other(ours: float, printed: float, spread: float) -> None:
    there, back = judge(ours, printed, spread, POINTS), judge(printed, ours, spread, POINTS)
    opposite = {Verdict.BETTER: Verdict.DIFFERS, Verdict.DIFFERS: Verdict.BETTER}
    assert back == opposite.get(there, Verdict.MATCHES)


def test_the_first_reason_that_fits_is_given() -> None:
    reasons = [
        Reason("simplified meshes", item="table1", row="SHREC*", verdict="[bd]*"),
        Reason("all else", verdict="differs"),
    ]
    assert reason_for(reasons, "table1", "SHREC1", "Ours", Verdict.BETTER) == "simplified meshes"
    assert reason_for(reasons, "table1", "McGill1", "Ours", Verdict.DIFFERS) == "all else"
    assert reason_for(reasons, "table1", "SHREC1", "Ours", Verdict.MATCHES) == ""


def test_verdicts_are_counted_in_one_order() -> None:
    counted = count([Verdict.DIFFERS, Verdict.MATCHES, Verdict.DIFFERS])
    assert list(counted.items()) == [(Verdict.MATCHES, 1), (Verdict.DIFFERS, 2)]
