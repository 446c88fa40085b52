"""Fingerprints change with the code that computes, and with nothing else."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from gipkg import fingerprints, registry
from gipkg.errors import BrokenPluginError
from gipkg.plugin_refs import PluginRef

LIBRARY = {
    "__init__.py": '_EXPORTS = {"draw": "gipkg.images"}\n',
    "errors.py": "class GipkgError(Exception): ...\n",
    "surfaces/__init__.py": "from gipkg.surfaces.area import area\n",
    "surfaces/area.py": "from gipkg.errors import GipkgError\ndef area(): return 1\n",
    "surfaces/unused.py": "x = 1\n",
    "images/__init__.py": "from ..surfaces.area import area\ndef draw(): return area()\n",
    "plugins/one.py": (
        "from typing import TYPE_CHECKING\n"
        "if TYPE_CHECKING:\n    from gipkg.surfaces import unused\n"
        "def run():\n    from gipkg.images import draw\n    return draw()\n"
    ),
    "plugins/lazy.py": "import gipkg\ndef run(): return gipkg.draw()\n",
    "plugins/other.py": "def run(): return 2\n",
    "plugins/narrow.py": "from gipkg.surfaces import unused\ndef run(): return unused.x\n",
}


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = tmp_path / "gipkg"
    for name, text in LIBRARY.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setattr(fingerprints, "_ROOT", root)
    return root


def plugin(name: str) -> PluginRef:
    return PluginRef("baseline", name, f"gipkg.plugins.{name}:run", "gipkg", "1", "built-in")


def edited(path: Path, text: str) -> None:
    path.write_text(path.read_text() + text)


@pytest.mark.parametrize("name", ["one", "lazy"])
def test_editing_a_function_two_imports_away_changes_it(library: Path, name: str) -> None:
    before = fingerprints.of_plugin(plugin(name)), fingerprints.of_plugin(plugin("other"))
    edited(library / "surfaces/area.py", "area.__name__ = 'b'\n")
    after = fingerprints.of_plugin(plugin(name)), fingerprints.of_plugin(plugin("other"))
    assert before[0] != after[0]
    assert before[1] == after[1]


def test_taking_a_module_from_a_package_does_not_take_the_whole_package(library: Path) -> None:
    before = fingerprints.of_plugin(plugin("narrow"))
    edited(library / "surfaces/area.py", "y = 2\n")
    assert fingerprints.of_plugin(plugin("narrow")) == before
    edited(library / "surfaces/unused.py", "y = 2\n")
    assert fingerprints.of_plugin(plugin("narrow")) != before


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("plugins/one.py", "# a comment\n"),
        ("plugins/one.py", "\n\n'a text that stands alone'\n"),
        ("surfaces/unused.py", "y = 2\n"),
        ("plugins/other.py", "y = 2\n"),
        ("errors.py", "class Other(GipkgError): ...\n"),
    ],
)
def test_what_computes_nothing_leaves_it_unchanged(library: Path, file: str, text: str) -> None:
    before = fingerprints.of_plugin(plugin("one"))
    edited(library / file, text)
    assert fingerprints.of_plugin(plugin("one")) == before


def test_a_package_stands_for_all_its_modules_and_what_they_import(library: Path) -> None:
    surfaces = fingerprints.fingerprint_module("gipkg.surfaces")
    images = fingerprints.fingerprint_module("gipkg.images")
    edited(library / "surfaces/unused.py", "y = 2\n")
    assert fingerprints.fingerprint_module("gipkg.surfaces") != surfaces
    assert fingerprints.fingerprint_module("gipkg.images") == images
    edited(library / "surfaces/area.py", "y = 2\n")
    assert fingerprints.fingerprint_module("gipkg.images") != images


@pytest.mark.parametrize(
    ("module", "used"),
    [
        ("parametrizers.optimal_transport", "parametrizers.conformal"),
        ("reporting.figures.figure1", "descriptors.curvature"),
        ("reporting.figures.figure5", "descriptors.hks"),
    ],
)
def test_a_plugin_that_another_module_uses_counts_with_it(module: str, used: str) -> None:
    assert f"gipkg.{used}" in fingerprints._closure({f"gipkg.{module}"})


def test_the_contracts_do_not_count_wherever_they_are_imported_from() -> None:
    package = fingerprints._ROOT / "surfaces" / "__init__.py"
    names = fingerprints._modules_below("gipkg.surfaces", package)
    closure = fingerprints._closure(names)
    assert names <= closure.keys()
    assert not [name for name in closure if name.startswith("gipkg.api")]


def test_an_absent_module_is_an_error(library: Path) -> None:
    with pytest.raises(ValueError, match=r"gipkg\.imags"):
        fingerprints.fingerprint_module("gipkg.imags")
    with pytest.raises(BrokenPluginError, match=r"gipkg\.plugins\.absent"):
        fingerprints.of_plugin(plugin("absent"))


def test_a_local_file_counts_with_the_library_it_uses(library: Path, tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text("from gipkg.surfaces.area import area\n")
    ref = PluginRef("baseline", "mine", f"{path}:Mine", None, None, "local")
    seen = {fingerprints.of_plugin(ref)}
    edited(path, "x = 1\n")
    seen.add(fingerprints.of_plugin(ref))
    edited(library / "surfaces/area.py", "y = 2\n")
    seen.add(fingerprints.of_plugin(ref))
    assert len(seen) == 3


def test_an_installed_package_counts_with_all_its_files_and_its_version(
    library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "fingerprinted"
    package.mkdir()
    (package / "__init__.py").write_text("raise ImportError('it was imported')\n")
    (package / "method.py").write_text("from gipkg.images import draw\n")
    (package / "weights.bin").write_bytes(b"\0\1")
    (package / "template.py").write_text("class {name}:\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    target = "fingerprinted.method:Mine"
    ref = PluginRef("baseline", "mine", target, "gipkg-mine", "1", "entry point")
    newer = PluginRef("baseline", "mine", target, "gipkg-mine", "2", "entry point")
    seen = {fingerprints.of_plugin(ref), fingerprints.of_plugin(newer)}
    (package / "weights.bin").write_bytes(b"\0\2")
    seen.add(fingerprints.of_plugin(ref))
    edited(library / "surfaces/area.py", "y = 2\n")
    seen.add(fingerprints.of_plugin(ref))
    assert len(seen) == 4


def test_every_source_of_gipkg_is_covered_by_a_copy_with_the_same_fingerprint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = fingerprints.fingerprint_module("gipkg")
    shutil.copytree(fingerprints._ROOT, tmp_path / "gipkg")
    monkeypatch.setattr(fingerprints, "_ROOT", tmp_path / "gipkg")
    assert fingerprints.fingerprint_module("gipkg") == here


def test_the_registry_finds_the_fingerprint_by_name() -> None:
    ref = registry.find("dataset", "articulated")
    assert registry.fingerprint("dataset", "articulated") == fingerprints.of_plugin(ref)
