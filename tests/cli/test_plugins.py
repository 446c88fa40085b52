"""``gipkg plugins``: what it prints, and how it ends."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from gipkg import cli, registry
from gipkg.plugin_refs import BUILTINS

WRONG = """
from typing import ClassVar
from gipkg.api import Descriptor

class Wrong(Descriptor):
    summary: ClassVar[str] = "has no channels"
    citation: ClassVar[str] = "none"
    def channels(self):
        return ()
    def describe(self, mesh, operators):
        return mesh.vertices[:, :0]
"""


def run(*arguments: str | Path) -> Result:
    return CliRunner().invoke(cli.main, [str(argument) for argument in arguments])


@pytest.fixture(autouse=True)
def no_local_plugins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "_local", {})


def test_list_prints_every_built_in_under_its_kind() -> None:
    result = run("plugins", "list")
    rows = [tuple(line.split()[:2]) for line in result.output.splitlines()]
    assert result.exit_code == 0
    assert {(kind, name) for kind, names in BUILTINS.items() for name in names} <= set(rows)


def test_list_as_json_of_one_kind() -> None:
    refs = json.loads(run("plugins", "list", "--kind", "descriptor", "--json").stdout)
    assert {ref["kind"] for ref in refs} == {"descriptor"}
    assert {"name", "target", "distribution", "version", "source"} <= set(refs[0])


def test_the_whole_listing_imports_nothing_heavy() -> None:
    code = (
        "import sys; from gipkg.cli import main\n"
        "try: main(['plugins', 'list'])\n"
        "except SystemExit: pass\n"
        "heavy = {'torch', 'numpy', 'pydantic', 'trimesh', 'pytest'} & set(sys.modules)\n"
        "sys.exit(str(heavy) if heavy else 0)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


def test_show_prints_parameters_tags_citation_and_file() -> None:
    result = run("plugins", "show", "hks")
    assert result.exit_code == 0
    for text in ("times", "int", ">= 1, <= 100", "intrinsic: yes", "citation: J. Sun", "hks.py"):
        assert text in result.output


def test_an_unknown_name_is_one_line_on_stderr_and_exit_code_1() -> None:
    for arguments in (("show", "hsk"), ("check", "hsk", "--kind", "descriptor")):
        result = run("plugins", *arguments)
        assert result.exit_code == 1
        assert result.stdout == ""
        assert len(result.stderr.splitlines()) == 1
        assert "did you mean 'hks'?" in result.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("plugins", "lits"),
        ("plugins", "list", "--kind", "descriptors"),
        ("plugins", "show", "mine.py:Mine"),
        ("plugins", "show", "absent.py:Mine", "--kind", "descriptor"),
        ("plugins", "new", "descriptor", "Bad_Name"),
        ("plugins", "new", "descriptor", "hks"),
        ("plugins", "check", "hks", "--expect-failure", "no-such-check=why"),
        ("plugins", "check", "hks", "--expect-failure", "repeats-itself"),
    ],
)
def test_wrong_usage_is_exit_code_2(arguments: tuple[str, ...]) -> None:
    assert run(*arguments).exit_code == 2


def test_a_name_of_two_kinds_asks_for_the_kind(tmp_path: Path) -> None:
    path = tmp_path / "plugin.py"
    path.write_text(WRONG)
    registry.register_local("baseline", "hks", f"{path}:Wrong")
    result = run("plugins", "show", "hks")
    assert result.exit_code == 2
    assert "--kind baseline or descriptor" in result.stderr


def test_doctor_imports_all_and_names_what_is_broken(tmp_path: Path) -> None:
    path = tmp_path / "bad.py"
    path.write_text("import a_library_that_is_gone\n")
    registry.register_local("descriptor", "bad", f"{path}:Bad")
    result = run("plugins", "doctor")
    assert result.exit_code == 1
    rows = [line.split() for line in result.output.splitlines()[1:]]
    states = {row[1]: row[-1] for row in rows if row and row[0] in registry.KINDS}
    assert states["bad"] == "broken"
    assert states["hks"] == "ok"
    assert "No module named 'a_library_that_is_gone'" in result.output


def test_check_counts_and_conforms() -> None:
    result = run("plugins", "check", "hks")
    assert result.exit_code == 0
    assert result.output == "hks: 15 run, 15 passed, 0 expected failures, 0 skipped\n"


def test_check_of_a_wrong_plugin_in_one_file(tmp_path: Path) -> None:
    path = tmp_path / "wrong_one.py"
    path.write_text(WRONG)
    result = run("plugins", "check", f"{path}:Wrong", "--kind", "descriptor")
    assert result.exit_code == 1
    assert "failed returns-an-array-of-channels: " in result.stdout
    assert "wrong-one: 11 run, 10 passed, 1 failed" in result.stdout
    assert "does not conform: failed: returns-an-array-of-channels" in result.stderr


def test_check_blames_a_plugin_for_its_own_defaults(tmp_path: Path) -> None:
    path = tmp_path / "unfounded.py"
    path.write_text(
        WRONG
        + """
    @pydantic.model_validator(mode="after")
    def _refuse(self):
        raise ValueError("no default is right")
"""
    )
    path.write_text("import pydantic\n" + path.read_text())
    result = run("plugins", "check", f"{path}:Wrong", "--kind", "descriptor")
    assert result.exit_code == 1
    assert "no default is right" in result.stderr
    assert "--expect-failure" not in result.stderr


def test_check_with_an_expected_failure(tmp_path: Path) -> None:
    path = tmp_path / "wrong_one.py"
    path.write_text(WRONG)
    expected = "returns-an-array-of-channels=it has none"
    result = run(
        *("plugins", "check", f"{path}:Wrong", "--kind", "descriptor"),
        *("--expect-failure", expected),
    )
    assert result.exit_code == 0, result.output
    assert "10 passed, 1 expected failures" in result.output


def test_new_does_not_overwrite(tmp_path: Path) -> None:
    assert run("plugins", "new", "baseline", "mine", "--directory", tmp_path).exit_code == 0
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    result = run("plugins", "new", "baseline", "mine", "--directory", tmp_path)
    assert result.exit_code == 1
    assert "exists already" in result.stderr
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == before


def test_commands_are_the_public_modules_of_the_package() -> None:
    commands = run("--help").output.partition("Commands:")[2]
    assert "plugins" in commands
    assert "_scaffold" not in commands
    assert "template" not in commands


def test_version() -> None:
    import gipkg

    assert gipkg.__version__ in run("--version").output
