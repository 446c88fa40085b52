"""The conformance checks of gipkg, one test each; tests of the method itself go below."""

from __future__ import annotations

from collections.abc import Callable

from gipkg_my_method import MyMethod

from gipkg.testing import parametrize_with_checks


@parametrize_with_checks([MyMethod()])
def test_conformance(check: Callable[[], None]) -> None:
    """The plugin keeps the contract of its kind and every promise of its tags."""
    check()
