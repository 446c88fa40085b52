"""Conformance checks for plugins of every kind, ours and other people's alike.

As tests of a plugin's own::

    from gipkg.testing import parametrize_with_checks

    @parametrize_with_checks([MyMethod(), MyMethod(steps=3)])
    def test_conformance(check):
        check()

and as a command, ``gipkg plugins check my-method``, which runs :func:`run_checks`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from gipkg import api
from gipkg.testing.suite import (
    Case,
    Check,
    CheckFailedError,
    Outcome,
    Report,
    Suite,
    require,
    require_known,
    run_suite,
)

if TYPE_CHECKING:
    import pytest

__all__ = [
    "CheckFailedError",
    "Outcome",
    "Report",
    "parametrize_with_checks",
    "require",
    "run_checks",
    "suite_of",
]

_SUITES: Mapping[type[api.Plugin], str] = {
    api.Parametrizer: "gipkg.testing.parametrizers",
    api.Descriptor: "gipkg.testing.descriptors",
    api.Baseline: "gipkg.testing.baselines",
    api.Dataset: "gipkg.testing.datasets",
}
_NONE: Mapping[str, str] = MappingProxyType({})


def suite_of(plugin: api.Plugin) -> Suite:
    """Return the conformance suite of a plugin's kind."""
    module = next(module for base, module in _SUITES.items() if isinstance(plugin, base))
    suite: Suite = import_module(module).SUITE
    return suite


def run_checks(
    plugin: api.Plugin,
    label: str | None = None,
    expected_failures: Mapping[str, str] = _NONE,
    data_root: Path | None = None,
) -> Report:
    """Run every check that applies to a plugin, and count them.

    Parameters
    ----------
    plugin : Plugin
        An instance.
    label : str, optional
        What to call it in the report; the class's name by default.
    expected_failures : mapping
        Name of a check that fails -> why it does; passing it is then a fault.
    data_root : Path, optional
        Folder of the real databases, for datasets that are read from files.

    Returns
    -------
    Report
        Its ``fault`` is None if the plugin conforms.

    Raises
    ------
    ValueError
        An expected failure names no check.
    """
    name = label or type(plugin).__name__
    return run_suite(suite_of(plugin), plugin, name, expected_failures, data_root)


def parametrize_with_checks(
    plugins: Sequence[api.Plugin], expected_failures: Mapping[str, str] = _NONE
) -> pytest.MarkDecorator:
    """Make a pytest test run once for every check of every plugin.

    The test takes the argument ``check`` and calls it; ``check(data_root)`` also runs the
    checks that read a database's files, which are skipped otherwise. The last check of each
    plugin holds the number of those that run against the floor of its kind.

    Parameters
    ----------
    plugins : sequence of Plugin
        Instances, of any kinds.
    expected_failures : mapping
        Name of a check that fails, for each of the plugins it applies to -> why it does; it
        is marked ``xfail(strict=True)``.

    Raises
    ------
    ValueError
        An expected failure names no check of these plugins' kinds.
    """
    import pytest

    require_known(expected_failures, *(suite_of(plugin) for plugin in plugins))
    return pytest.mark.parametrize(
        "check",
        [
            pytest.param(
                case,
                id=f"{type(plugin).__name__}-{case.name}",
                marks=_marks(expected_failures.get(case.name)),
            )
            for plugin in plugins
            for case in [*suite_of(plugin).cases(plugin), _enough_checks(plugin)]
        ],
    )


def _marks(reason: str | None) -> Sequence[Any]:
    import pytest

    return () if reason is None else (pytest.mark.xfail(reason=reason, strict=True),)


def _enough_checks(plugin: api.Plugin) -> Case:
    suite = suite_of(plugin)

    def enough(_: api.Plugin) -> None:
        number = sum(not case.check.needs_data for case in suite.cases(plugin))
        require(number >= suite.floor, f"only {number} checks apply; its kind needs {suite.floor}")

    return Case(Check("enough-checks", enough, lambda _: True, needs_data=False), plugin)
