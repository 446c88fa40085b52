"""What is shipped: the wheel, the metadata, and the packages that ``plugins new`` writes."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import gipkg
from gipkg.cli._scaffold import write_package
from gipkg.registry import KINDS

REPOSITORY = Path(__file__).resolve().parents[1]
PIP = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
BARE = ("--no-deps", "--no-build-isolation", "--no-index")


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


def test_the_wheel_holds_the_template_the_licence_and_the_typing_marker(tmp_path: Path) -> None:
    source = tmp_path / "source"
    source.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(REPOSITORY / name, source)
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(REPOSITORY / "gipkg", source / "gipkg", ignore=ignored)
    subprocess.run([*PIP, "wheel", *BARE, "--wheel-dir", tmp_path, source], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    held = set(zipfile.ZipFile(wheel).namelist())
    shipped = {
        path.relative_to(source).as_posix()
        for path in (source / "gipkg").rglob("*")
        if path.suffix == ".py" or "template" in path.parts or path.name == "py.typed"
        if path.is_file()
    }
    assert "gipkg/cli/template/src/gipkg_my_method/descriptor.py" in shipped
    assert shipped <= held
    assert f"gipkg-{gipkg.__version__}.dist-info/licenses/LICENSE" in held


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
