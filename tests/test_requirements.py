"""The three lists of what gipkg needs say the same."""

from __future__ import annotations

import re
import tomllib

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

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
