"""A survey sums up the surfaces of a database, and names why there are none."""

from __future__ import annotations

import pytest

from gipkg.errors import TooManyFailures
from gipkg.reporting.survey import Survey, survey


def report(vertices: int, *steps: str) -> dict[str, object]:
    return {"after": {"vertices": vertices}, "steps": [{"name": name} for name in steps]}


def test_a_survey_counts_surfaces_vertices_repairs_and_failures() -> None:
    reports = {"a": report(10), "b": report(30, "cut handles", "fill holes"), "c": report(20)}
    found = survey(reports, {"d": "UnsupportedMesh: open"})
    assert found == Survey(
        surfaces=3,
        vertices=(10, 20, 30),
        repaired={"b": ["cut handles", "fill holes"]},
        failures={"d": "UnsupportedMesh: open"},
    )


def test_where_no_surface_is_left_every_failure_is_named() -> None:
    failures = {"d": "UnsupportedMesh: open", "c": "MeshFormatError: empty"}
    with pytest.raises(TooManyFailures, match="all 2 shapes") as caught:
        survey({}, failures)
    lines = str(caught.value).splitlines()
    assert "surface: method" in lines[0]
    assert lines[1:] == ["  c: MeshFormatError: empty", "  d: UnsupportedMesh: open"]
