"""What the documentation names is there: paths, modules, commands and results."""

from __future__ import annotations

import re
from pathlib import Path
from pkgutil import resolve_name

import click
import pytest

from gipkg import cli
from tests.workflow.workdir import REPOSITORY, Workdir

PAGES = [
    *sorted(REPOSITORY.glob("*.md")),
    REPOSITORY / "config" / "README.md",
    *sorted((REPOSITORY / "docs").rglob("*.md")),
]
BENCHMARKS = sorted((REPOSITORY / "benchmarks").glob("*.py"))

FOLDERS = r"(?:\.ci|benchmarks|config|docs|gipkg|profiles|results/reference|tests|workflow)"
PATH = re.compile(rf"(?<![\w./-]){FOLDERS}/[\w./-]*")
FILE = re.compile(r"(?<![\w./-])(?:test_\w+\.py|[\w-]+\.(?:smk|txt|toml|md|yml)|[A-Z]+\.cff)\b")

TO_BE_WRITTEN = {
    "gipkg/descriptors/gaussian_curvature.py",
    "tests/descriptors/test_gaussian_curvature.py",
}
"""The worked example of CONTRIBUTING.md."""


def code_of(page: Path) -> list[str]:
    """Return what stands between back quotes in the text of a page."""
    text = re.sub(r"^ *```.*?^ *```$", "", page.read_text(), flags=re.M | re.S)
    return re.findall(r"`([^`]+)`", text)


def every_match(pattern: str) -> list[str]:
    """Return what a pattern finds on any page, code blocks included."""
    return sorted({one for page in PAGES for one in re.findall(pattern, page.read_text())})


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(REPOSITORY)))
def test_every_path_exists(page: Path) -> None:
    paths = {path for code in code_of(page) for path in PATH.findall(code)} - TO_BE_WRITTEN
    assert [path for path in sorted(paths) if not (REPOSITORY / path).exists()] == []
    names = {name for code in code_of(page) for name in FILE.findall(PATH.sub("", code))}
    known = {path.name for path in REPOSITORY.glob("*")}
    known |= {path.name for folder in ("tests", "workflow") for path in _files(folder)}
    assert sorted(names - known) == []


def test_what_is_to_be_written_is_not_there() -> None:
    assert not any((REPOSITORY / path).exists() for path in TO_BE_WRITTEN)


def test_every_benchmark_exists_and_starts_as_a_module() -> None:
    named = every_match(r"\bbenchmarks\.(\w+)")
    assert len(named) > 5
    assert set(named) <= {path.stem for path in BENCHMARKS}
    assert every_match(r"python benchmarks/\S+") == []
    for path in BENCHMARKS:
        assert f"\n    python -m benchmarks.{path.stem} " in path.read_text()


def test_every_name_of_the_library_is_there() -> None:
    names = every_match(r"(?<![\w/.-])gipkg(?:\.[A-Za-z_]\w*)+")
    assert len(names) > 30
    for name in names:
        resolve_name(name)


def test_every_command_is_there() -> None:
    commands = every_match(r"(?:`|^)gipkg ([a-z]+(?: [a-z]+)?)")
    assert len(commands) > 10
    context = click.Context(cli.main)
    for command in commands:
        first, *rest = command.split()
        found = cli.main.get_command(context, first)
        assert found, command
        if isinstance(found, click.Group):
            assert set(rest) <= set(found.list_commands(context)), command


def test_every_result_is_made_by_a_rule(tmp_path: Path) -> None:
    results = every_match(r"results/\w+\.(?:csv|html|json|md|png)")
    assert len(results) > 10
    done = Workdir(tmp_path).run(*results, "--dry-run")
    assert done.returncode == 0, done.stdout


def test_every_folder_of_results_is_filled_by_a_rule() -> None:
    rules = "".join(path.read_text() for path in (REPOSITORY / "workflow/rules").glob("*.smk"))
    named = set(every_match(r"results/[a-z]+/")) - {"results/reference/"}
    made = set(re.findall(r"results/[a-z]+/", rules.replace("{stage}", "images")))
    assert sorted(named - made) == []


def _files(folder: str) -> list[Path]:
    return [path for path in (REPOSITORY / folder).rglob("*") if path.is_file()]
