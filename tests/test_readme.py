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


def blocks(language: str) -> list[str]:
    """Return the blocks in that language, less their indentation."""
    found = re.findall(rf"^( *)```{language}\n(.*?)^ *```$", TEXT, re.MULTILINE | re.DOTALL)
    return [re.sub(rf"^{indentation}", "", code, flags=re.MULTILINE) for indentation, code in found]


def block(language: str) -> str:
    """Return the one block in that language."""
    (code,) = blocks(language)
    return code


def run_as_in_a_shell(code: str) -> None:
    """Run lines of ``gipkg …`` in this folder, file patterns expanded."""
    for program, *arguments in map(shlex.split, code.splitlines()):
        assert program == "gipkg"
        expanded = [path for one in arguments for path in _expanded(one)]
        done = CliRunner().invoke(cli.main, expanded)
        assert done.exit_code == 0, done.output


def _expanded(argument: str) -> list[str]:
    found = sorted(map(str, Path().glob(argument))) if "*" in argument else []
    return found or [argument]


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
    run_as_in_a_shell(blocks("sh")[0])
    again = trimesh.load(tmp_path / "again.glb", force="mesh")
    assert again.volume == pytest.approx(mesh.volume, rel=0.02)


def test_a_folder_of_soups_becomes_images_and_pictures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    legs = [trimesh.creation.box((0.2, 0.2, 1)).apply_translation([x, 0, 0.5]) for x in (-1, 1)]
    for name, height in (("low", 1.2), ("high", 1.5)):  # a plate that does not touch its legs
        plate = trimesh.creation.box((3, 2, 0.2)).apply_translation([0, 0, height])
        trimesh.util.concatenate([plate, *legs]).export(tmp_path / f"{name}.off")
    monkeypatch.chdir(tmp_path)
    run_as_in_a_shell(blocks("sh")[1])
    for folder, suffix in (("maps", "npz"), ("images", "tiff"), ("pictures", "png")):
        written = sorted(path.name for path in (tmp_path / folder).iterdir())
        assert written == [f"high.{suffix}", f"low.{suffix}"]


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
