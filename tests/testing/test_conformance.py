"""Every built-in passes its conformance suite, found and built like anybody's plugin."""

from __future__ import annotations

from pathlib import Path

import pytest

from gipkg import registry
from gipkg.plugin_refs import BUILTINS
from gipkg.testing import parametrize_with_checks, run_checks, suite_of

NARROW = {
    "deeppano": {"maps": [2, 4, 4, 8], "features": 16},
    "shapenets": {"rotations": 2, "maps": [4, 4, 8], "widths": [16]},
    "voxnet": {"rotations": 2, "minimum_steps": 30},
}
"""What is trained long makes the same promises with fewer units and steps."""
BUILT_IN = [
    registry.create(kind, name, NARROW.get(name, {}))
    for kind, names in BUILTINS.items()
    for name in names
]


@pytest.fixture
def data_root_or_none(request: pytest.FixtureRequest) -> Path | None:
    try:
        root: Path = request.getfixturevalue("data_root")
    except pytest.skip.Exception:
        return None
    return root


@parametrize_with_checks(BUILT_IN)
def test_built_in(check, data_root_or_none: Path | None) -> None:
    check(data_root_or_none)


@pytest.mark.parametrize("kind", registry.KINDS)
def test_the_floor_is_the_number_of_checks_that_do_not_depend_on_tags_or_files(kind: str) -> None:
    suites = {registry.find(kind, name).kind: suite_of(plugin) for name, plugin in named(kind)}
    applicable = [
        sum(not case.check.needs_data for case in suites[kind].cases(plugin))
        for _, plugin in named(kind)
    ]
    assert 8 <= suites[kind].floor <= min(applicable)


def test_without_data_a_real_database_still_runs_enough_checks(tmp_path: Path) -> None:
    report = run_checks(registry.create("dataset", "shrec11"), "shrec11", data_root=tmp_path)
    assert report.fault is None
    assert report.count("skipped") >= 5
    assert report.run >= report.floor


def named(kind: str) -> list[tuple[str, object]]:
    return [(name, registry.create(kind, name)) for name in BUILTINS[kind]]
