"""The three lists of what gipkg needs say the same."""

from __future__ import annotations

import re
import tomllib

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from benchmarks.lowest import lowest
from tests.workflow.workdir import REPOSITORY

PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]


def requirements(*extras: str) -> list[Requirement]:
    """Return the direct requirements of the library and of some extras, but itself."""
    texts = PROJECT["dependencies"] + [
        text for extra in extras for text in PROJECT["optional-dependencies"][extra]
    ]
    found = [Requirement(text) for text in texts]
    return [one for one in found if canonicalize_name(one.name) != "gipkg"]


def pins(lines: list[str]) -> dict[str, str]:
    """Return name -> version of lines such as ``numpy==2.4.6``."""
    parts = [line.partition("==") for line in lines if not line.startswith("#")]
    return {canonicalize_name(name): version for name, _, version in parts}


@pytest.fixture(scope="module")
def constraints() -> dict[str, str]:
    return pins((REPOSITORY / "constraints.txt").read_text().splitlines())


def test_every_requirement_is_pinned_to_a_version_that_it_allows(
    constraints: dict[str, str],
) -> None:
    for requirement in requirements(*PROJECT["optional-dependencies"]):
        version = constraints[canonicalize_name(requirement.name)]
        assert requirement.specifier.contains(version), requirement


def test_pins_are_exact_and_of_no_particular_build(constraints: dict[str, str]) -> None:
    for name, version in constraints.items():
        assert re.fullmatch(r"[0-9]+(\.[0-9a-z]+)*", version), f"{name}=={version}"


def test_the_conda_environment_is_in_step(constraints: dict[str, str]) -> None:
    environment = yaml.safe_load((REPOSITORY / "environment.yml").read_text())
    *others, pip = environment["dependencies"]
    assert others == ["python=3.11", "pip"]
    extras = "learn", "figures", "workflow", "test"
    names = {canonicalize_name(one.name) for one in requirements(*extras)}
    assert pins(pip["pip"]) == {name: constraints[name] for name in names}


def test_every_dependency_has_its_reason() -> None:
    table = (REPOSITORY / "docs" / "dependencies.md").read_text()
    rows = [re.split(r" *\| *", line)[1:-1] for line in table.splitlines() if line.startswith("|")]
    said = {(name, bound, extra) for name, bound, extra, reason in rows[2:] if len(reason) > 3}
    extras = {"": PROJECT["dependencies"], **PROJECT["optional-dependencies"]}
    needed = {
        (one.name, ",".join(sorted(map(str, one.specifier), reverse=True)), extra)
        for extra, texts in extras.items()
        for one in map(Requirement, texts)
        if one.name != "gipkg"
    }
    assert said == needed
    assert len(rows[2:]) == len(needed)


def test_the_lowest_versions_are_those_that_are_allowed() -> None:
    lines = (REPOSITORY / "constraints-lowest.txt").read_text().splitlines()
    assert pins(lines) == {canonicalize_name(name): bound for name, bound in lowest().items()}
