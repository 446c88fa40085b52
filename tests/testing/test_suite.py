"""What all suites share: counting, expected failures, and the checks of every kind."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

import numpy as np
import pytest
from pydantic import ConfigDict, Field

from gipkg.api import Descriptor
from gipkg.testing import parametrize_with_checks, require, run_checks, suite_of
from gipkg.testing.suite import Suite, run_suite


class Height(Descriptor):
    summary: ClassVar[str] = "the height"
    citation: ClassVar[str] = "none"

    def channels(self):
        return ("height",)

    def describe(self, mesh, operators):
        return np.array(mesh.vertices[:, 2:])


class Misnamed(Height):
    def channels(self):
        return ("height", "width")


class Silent(Height):
    citation: ClassVar[str] = " "


class Lenient(Height):
    model_config = ConfigDict(extra="ignore")


class Thawed(Height):
    model_config = ConfigDict(frozen=False)
    factor: float = Field(1.0, description="a factor")


class Unbounded(Height):
    factor: int = Field(1, description="a factor", json_schema_extra={"minimum": 0})


class Unjson(Height):
    limits: float = Field(float("inf"), description="JSON has no infinity")


class Local(Height):
    @cached_property
    def held(self):
        return lambda: None

    def __getstate__(self):
        raise TypeError("it holds a lambda")


WRONG = {
    Silent: {"metadata-is-complete"},
    Lenient: {"refuses-unknown-parameters"},
    Thawed: {"cannot-be-changed"},
    Unbounded: {"enforces-bounds"},
    Unjson: {"parameters-survive-json"},
    Local: {"survives-pickling"},
}


@pytest.mark.parametrize("plugin", WRONG)
def test_a_wrong_plugin_fails_the_check_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert failed_checks(plugin()) == WRONG[plugin]


def test_every_common_check_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == common_checks


def test_the_summary_counts_what_ran() -> None:
    report = run_checks(Height(), "height")
    assert report.summary() == "height: 11 run, 11 passed, 0 expected failures, 0 skipped"


def test_an_expected_failure_must_fail() -> None:
    fails = run_checks(Misnamed(), expected_failures={"returns-an-array-of-channels": "on purpose"})
    passes = run_checks(Height(), expected_failures={"repeats-itself": "a guess"})
    assert fails.fault is None
    assert fails.count("expected failure") == 1
    assert "failed: repeats-itself" in str(passes.fault)


def test_an_expected_failure_must_name_a_check() -> None:
    with pytest.raises(ValueError, match="no such check: repeats-itsself"):
        run_checks(Height(), expected_failures={"repeats-itsself": "misspelt"})
    with pytest.raises(ValueError, match="no such check"):
        parametrize_with_checks([Height()], {"covers-the-sphere-once": "of another kind"})


def test_too_few_checks_are_a_fault() -> None:
    suite = Suite(floor=2)
    suite.check()(lambda plugin: require(True, ""))
    report = run_suite(suite, Height(), "height", {}, None)
    assert report.fault == "only 1 checks ran; its kind needs 2"


def test_pytest_parametrization_counts_and_marks_strictly() -> None:
    mark = parametrize_with_checks([Misnamed()], {"returns-an-array-of-channels": "on purpose"})
    name, cases = mark.args
    ids = {case.id: case.marks for case in cases}
    assert name == "check"
    assert len(ids) == len(suite_of(Misnamed()).cases(Misnamed())) + 1
    (xfail,) = ids["Misnamed-returns-an-array-of-channels"]
    assert xfail.kwargs == {"reason": "on purpose", "strict": True}
    assert "Misnamed-enough-checks" in ids
