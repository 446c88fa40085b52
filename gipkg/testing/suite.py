"""What a conformance suite is: named checks, chosen by what a plugin promises, and counted.

A suite that runs no checks is green too; hence the floor: a plugin fails when fewer checks
than the floor of its kind have run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal
from unittest import SkipTest

from gipkg.api import Dataset, Plugin

Status = Literal["passed", "failed", "expected failure", "unexpected pass", "skipped"]


class CheckFailedError(AssertionError):
    """A plugin does not keep a promise; the message says which, and by how much."""


def require(condition: Any, message: str) -> None:
    """Raise CheckFailedError unless the condition holds; unlike ``assert``, also under -O."""
    if not condition:
        raise CheckFailedError(message)


def always(_: Any) -> bool:
    """Choose a check for every plugin of its kind."""
    return True


@dataclass(frozen=True, slots=True)
class Check:
    """One promise, as a function that raises where it is not kept."""

    name: str
    function: Callable[..., None]
    applies: Callable[[Any], bool]
    needs_data: bool


@dataclass(frozen=True, slots=True)
class Suite:
    """The checks of one kind of plugin.

    Attributes
    ----------
    floor : int
        The fewest checks that must run; those that depend on tags or files are not in it.
    """

    floor: int
    checks: dict[str, Check] = field(default_factory=dict)

    def check(
        self, *, when: Callable[[Any], bool] = always, needs_data: bool = False
    ) -> Callable[[Callable[..., None]], Callable[..., None]]:
        """Add the decorated function under its name.

        It is called with the plugin and, if it `needs_data`, with the data root.
        """

        def add(function: Callable[..., None]) -> Callable[..., None]:
            name = function.__name__.replace("_", "-")
            self.checks[name] = Check(name, function, when, needs_data)
            return function

        return add

    def cases(self, plugin: Plugin) -> list[Case]:
        """Return the checks that apply to a plugin, in the order of their definition."""
        return [Case(check, plugin) for check in self.checks.values() if check.applies(plugin)]


@dataclass(frozen=True, slots=True)
class Case:
    """One check on one plugin; calling it runs it.

    Raises
    ------
    unittest.SkipTest
        It needs files that are not under the data root.
    """

    check: Check
    plugin: Plugin

    @property
    def name(self) -> str:
        """The name of the check."""
        return self.check.name

    def __call__(self, data_root: Path | None = None) -> None:
        """Run the check, with the folder of the real databases where there is one."""
        if not self.check.needs_data:
            self.check.function(self.plugin)
            return
        with TemporaryDirectory() as empty:
            root = data_root or Path(empty)
            if isinstance(self.plugin, Dataset) and not self.plugin.available(root):
                raise SkipTest(f"its files are not under {data_root or 'a data root'}")
            self.check.function(self.plugin, root)


@dataclass(frozen=True, slots=True)
class Outcome:
    """How one check ended, and why."""

    name: str
    status: Status
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Report:
    """How all checks of one plugin ended."""

    plugin: str
    floor: int
    outcomes: Sequence[Outcome]

    def count(self, status: Status) -> int:
        """Count the checks that ended so."""
        return sum(outcome.status == status for outcome in self.outcomes)

    @property
    def run(self) -> int:
        """How many checks ran, to whatever end."""
        return len(self.outcomes) - self.count("skipped")

    @property
    def fault(self) -> str | None:
        """Why the plugin does not conform, or None."""
        if bad := [o.name for o in self.outcomes if o.status in ("failed", "unexpected pass")]:
            return f"failed: {', '.join(bad)}"
        if self.run < self.floor:
            return f"only {self.run} checks ran; its kind needs {self.floor}"
        return None

    def summary(self) -> str:
        """Return the line that says how many checks ran and how they ended."""
        counts = [f"{self.count('passed')} passed"]
        counts += [
            f"{number} {status}"
            for status in ("failed", "unexpected pass")
            if (number := self.count(status))
        ]
        counts += [
            f"{self.count('expected failure')} expected failures",
            f"{self.count('skipped')} skipped",
        ]
        return f"{self.plugin}: {self.run} run, {', '.join(counts)}"


def run_suite(
    suite: Suite,
    plugin: Plugin,
    label: str,
    expected_failures: Mapping[str, str],
    data_root: Path | None,
) -> Report:
    """Run a suite on one plugin.

    Parameters
    ----------
    suite : Suite
        The suite of its kind.
    plugin : Plugin
        An instance.
    label : str
        Its name in the report.
    expected_failures : mapping
        Name of a check that must fail -> why it does.
    data_root : Path or None
        Folder of the real databases.

    Raises
    ------
    ValueError
        An expected failure names no check of the suite.
    """
    require_known(expected_failures, suite)
    outcomes = [
        _outcome(case, expected_failures.get(case.name), data_root) for case in suite.cases(plugin)
    ]
    return Report(label, suite.floor, outcomes)


def require_known(names: Mapping[str, str], *suites: Suite) -> None:
    """Raise ValueError for a name that none of the suites has."""
    known = {name for suite in suites for name in suite.checks}
    if unknown := sorted(set(names) - known):
        raise ValueError(
            f"no such check: {', '.join(unknown)} (checks: {', '.join(sorted(known))})"
        )


def _outcome(case: Case, reason: str | None, data_root: Path | None) -> Outcome:
    try:
        case(data_root)
    except SkipTest as skip:
        return Outcome(case.name, "skipped", str(skip))
    except Exception as error:
        status: Status = "failed" if reason is None else "expected failure"
        return Outcome(case.name, status, reason or f"{type(error).__name__}: {error}")
    if reason is None:
        return Outcome(case.name, "passed")
    return Outcome(case.name, "unexpected pass", f"expected to fail: {reason}")
