"""Fixtures of the tests of the conformance suites."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from gipkg.api import Plugin
from gipkg.testing import run_checks
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite


@pytest.fixture
def failed_checks() -> Callable[[Plugin], set[str]]:
    """Run the suite of a plugin and return the names of the checks that failed."""

    def run(plugin: Plugin) -> set[str]:
        outcomes = run_checks(plugin).outcomes
        return {outcome.name for outcome in outcomes if outcome.status == "failed"}

    return run


@pytest.fixture
def common_checks() -> set[str]:
    """Names of the checks that every kind has."""
    suite = Suite(floor=0)
    add_common_checks(suite)
    return set(suite.checks)
