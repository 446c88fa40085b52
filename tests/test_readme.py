"""What the README shows works as it stands there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
import trimesh
import yaml
from click.testing import CliRunner

from gipkg import cli
from tests.workflow.workdir import REPOSITORY, Workdir

TEXT = (REPOSITORY / "README.md").read_text()

LIKE_CONFORMAL = """
from gipkg.parametrizers.conformal import Conformal


class Mine(Conformal):
    pass
"""


def block(language: str) -> str:
    """Return the one block in that language, less its indentation."""
    (found,) = re.findall(rf"^( *)```{language}\n(.*?)^ *```$", TEXT, re.MULTILINE | re.DOTALL)
    indentation, code = found
    return re.sub(rf"^{indentation}", "", code, flags=re.MULTILINE)


def test_the_parts_work_from_python(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = trimesh.creation.icosphere(subdivisions=3)
    mesh.apply_scale([1.0, 1.0, 2.0])
    mesh.export(tmp_path / "mesh.obj")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    exec(block("python"), names)
    again = trimesh.load(tmp_path / "again.obj", force="mesh")
    assert again.is_watertight
    assert again.volume == pytest.approx(mesh.volume, rel=0.02)
    assert np.shape(names["image"]) == (3, 128, 128)
    assert np.shape(names["signature"]) == (len(mesh.vertices), 5)


def test_the_parts_work_from_the_shell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = trimesh.creation.icosphere(subdivisions=2)
    mesh.export(tmp_path / "mesh.obj")
    monkeypatch.chdir(tmp_path)
    commands = [shlex.split(line) for line in block("sh").splitlines()]
    assert {program for program, *_ in commands} == {"gipkg"}
    for _, *arguments in commands:
        done = CliRunner().invoke(cli.main, arguments)
        assert done.exit_code == 0, done.output
    again = trimesh.load(tmp_path / "again.glb", force="mesh")
    assert again.volume == pytest.approx(mesh.volume, rel=0.02)


def test_a_method_of_ones_own_is_named_as_shown(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(LIKE_CONFORMAL)
    done = Workdir(tmp_path).run("--dry-run", config=yaml.safe_load(block("yaml")))
    assert done.returncode == 0, done.stdout
    assert "results/evaluation/table1/tiny/mine/Tiny1.json" in done.stdout


def test_the_two_commands_are_the_only_shell_blocks() -> None:
    commands = re.findall(r"^```bash\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
    assert [text.splitlines()[-1] for text in commands] == [
        "snakemake --cores 2 results/table1.csv",
        "pytest -n 2",
    ]
