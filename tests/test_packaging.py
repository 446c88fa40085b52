"""What is shipped: the wheel, the metadata, and the packages that ``plugins new`` writes."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import trimesh

import gipkg
from gipkg.cli._scaffold import write_package
from gipkg.registry import KINDS

REPOSITORY = Path(__file__).resolve().parents[1]
PIP = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
BARE = ("--no-deps", "--no-build-isolation", "--no-index")

EXTRAS = ("jsonschema", "matplotlib", "pyvista", "snakemake", "torch", "vtk", "vtkmodules", "yaml")

WITHOUT_EXTRAS = f"""
import json, sys

class Hiding:
    def __init__(self, finder):
        self.finder = finder

    def find_spec(self, name, path=None, target=None):
        hidden = name.partition(".")[0] in {EXTRAS}
        return None if hidden else self.finder.find_spec(name, path, target)

    def __getattr__(self, name):
        return getattr(self.finder, name)

sys.meta_path[:] = map(Hiding, sys.meta_path)
import gipkg
sys.stderr.write(gipkg.__file__ + "\\n")
from gipkg.cli import main
for arguments in json.loads(sys.argv[1]):
    try:
        main(arguments)
    except SystemExit as end:
        if end.code:
            raise
"""


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Install one new package of every kind, named after it, beside this environment."""
    folder = tmp_path_factory.mktemp("packages")
    packages = [folder / f"gipkg-new-{kind}" for kind in KINDS]
    for kind, package in zip(KINDS, packages, strict=True):
        write_package(kind, f"new-{kind}", package)
    site = folder / "site"
    subprocess.run([*PIP, "install", *BARE, "--target", site, *packages], check=True)
    return site


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_package_installs_and_passes_its_checks(installed: Path, kind: str) -> None:
    result = gipkg_beside(installed, "plugins", "check", f"new-{kind}", "--kind", kind)
    assert re.match(rf"new-{kind}: (\d+) run, \1 passed, 0 expected failures, 0 sk", result)
    assert f"gipkg-new-{kind} 0.1.0" in gipkg_beside(installed, "plugins", "list")


def test_the_tests_of_a_new_package_pass(installed: Path) -> None:
    package = installed.parent / "gipkg-new-descriptor"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", package]
    subprocess.run(command, check=True, cwd=package, env=environment(installed))


def test_a_new_package_holds_no_placeholder(installed: Path) -> None:
    for path in installed.parent.glob("gipkg-*/**/*"):
        if path.suffix in (".py", ".toml", ".md"):
            placeholder = re.search(r"my.?method|my-kind", path.read_text(), re.IGNORECASE)
            assert placeholder is None, path
            assert "my_method" not in str(path.relative_to(installed.parent))


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel from what a source distribution holds."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    source.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(REPOSITORY / name, source)
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(REPOSITORY / "gipkg", source / "gipkg", ignore=ignored)
    subprocess.run([*PIP, "wheel", *BARE, "--wheel-dir", folder, source], check=True)
    (built,) = folder.glob("*.whl")
    return built


def test_the_wheel_holds_every_file_of_the_package_and_the_licence(wheel: Path) -> None:
    held = set(zipfile.ZipFile(wheel).namelist())
    source = wheel.parent / "source"
    shipped = {
        path.relative_to(source).as_posix()
        for path in (source / "gipkg").rglob("*")
        if path.is_file()
    }
    assert {"gipkg/py.typed", "gipkg/cli/template/pyproject.toml"} <= shipped
    assert shipped <= held
    others = {name for name in held - shipped if ".dist-info/" not in name}
    assert others == set()
    assert f"gipkg-{gipkg.__version__}.dist-info/licenses/LICENSE" in held


def test_the_wheel_alone_has_every_command_and_plugin_without_any_extra(
    wheel: Path, tmp_path: Path
) -> None:
    site = tmp_path / "site"
    subprocess.run([*PIP, "install", *BARE, "--target", site, wheel], check=True)
    run_without_extras(
        site, tmp_path, ["plugins", "doctor"], ["--help"], ["data", "list"], ["image", "--help"]
    )
    for arguments, extra in (
        (["view", "box.stl", "-o", "box.png"], "figures"),
        (["index", ".", "--network", str(wheel)], "learn"),
        (["search", "box.stl", "--index", "index.npz"], "learn"),
    ):
        said = run_without_extras(site, tmp_path, arguments, exit_code=1)
        assert f'pip install "gipkg[{extra}]"' in said


def test_no_extra_is_needed_from_mesh_to_mesh(tmp_path: Path) -> None:
    box = trimesh.creation.box().subdivide().subdivide()
    box.export(tmp_path / "box.stl")
    run_without_extras(
        REPOSITORY,
        tmp_path,
        ["prepare", "box.stl", "-o", "closed.ply"],
        ["parametrize", "closed.ply", "-o", "map.npz"],
        ["image", "map.npz", "-o", "image.tiff", "--size", "32"],
        ["reconstruct", "image.tiff", "-o", "again.off"],
    )
    again = trimesh.load(tmp_path / "again.off")
    assert again.is_watertight
    assert again.volume == pytest.approx(box.volume, rel=0.05)


def run_without_extras(site: Path, folder: Path, *commands: list[str], exit_code: int = 0) -> str:
    """Run commands of the gipkg in `site` as if no extra were installed; return what is said."""
    run = subprocess.run(
        [sys.executable, "-c", WITHOUT_EXTRAS, json.dumps(commands)],
        env={**os.environ, "PYTHONPATH": str(site)},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.stderr.startswith(str(site / "gipkg")), run.stderr
    assert run.returncode == exit_code, run.stdout + run.stderr
    return run.stderr


def test_the_citation_names_the_version() -> None:
    text = (REPOSITORY / "CITATION.cff").read_text()
    assert re.search(rf"^version: {re.escape(gipkg.__version__)}$", text, re.MULTILINE)


def gipkg_beside(site: Path, *arguments: str) -> str:
    command = [sys.executable, "-c", "from gipkg.cli import main; main()", *arguments]
    run = subprocess.run(
        command, env=environment(site), capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def environment(site: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": os.pathsep.join((str(site), str(REPOSITORY)))}
