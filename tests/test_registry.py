"""The registry: three sources, one table; laziness, clashes and broken plugins."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import pytest

from gipkg import registry
from gipkg.errors import (
    BrokenPluginError,
    DuplicatePluginError,
    InvalidParameterError,
    UnknownPluginError,
)
from gipkg.plugin_refs import BUILTINS

PLUGIN = '''
"""A descriptor for the tests."""
from typing import ClassVar, Literal
import numpy as np
from pydantic import Field
from gipkg.api import Descriptor

class Constant(Descriptor):
    summary: ClassVar[str] = "the same value everywhere"
    citation: ClassVar[str] = "none"
    value: float = Field(1.0, ge=0.0, description="the value")
    flavour: Literal["plain", "sweet"] = Field("plain", description="the taste")
    def channels(self):
        return ("constant",)
    def describe(self, mesh, operators):
        return np.full((len(mesh.vertices), 1), self.value)
'''


class Site:
    """A folder on ``sys.path`` that distributions are installed into."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def install(
        self, distribution: str, entry_points: str, version: str = "0.2", **modules: str
    ) -> None:
        info = self.folder / f"{distribution.replace('-', '_')}-{version}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {distribution}\nVersion: {version}\n"
        )
        (info / "entry_points.txt").write_text(dedent(entry_points))
        for name, text in modules.items():
            (self.folder / f"{name}.py").write_text(text)


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Site:
    folder = tmp_path / "site"
    folder.mkdir()
    monkeypatch.syspath_prepend(str(folder))
    before = set(sys.modules)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    yield Site(folder)
    for name in set(sys.modules) - before:
        if str(folder) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


@pytest.fixture(autouse=True)
def no_local_plugins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "_local", {})


def names(kind: str) -> list[str]:
    return [ref.name for ref in registry.list_plugins(kind)]


def local_file(folder: Path, text: str = PLUGIN, name: str = "mine.py") -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("kind", registry.KINDS)
def test_builtins_are_listed_sorted_with_their_origin(kind: str) -> None:
    refs = registry.list_plugins(kind)
    assert [ref.name for ref in refs] == sorted(ref.name for ref in refs)
    builtins = {ref.name: ref.target for ref in refs if ref.source == "built-in"}
    assert builtins == dict(BUILTINS[kind])


def test_an_installed_plugin_is_found_in_a_live_session(site: Site) -> None:
    assert "constant" not in names("descriptor")
    site.install("gipkg-c", "[gipkg.descriptors]\nconstant = mod_c:Constant\n", mod_c=PLUGIN)
    ref = registry.find("descriptor", "constant")
    assert (ref.distribution, ref.version, ref.source) == ("gipkg-c", "0.2", "entry point")
    assert registry.get("descriptor", "constant").__name__ == "Constant"


def test_underscores_and_dashes_are_the_same(site: Site) -> None:
    site.install("gipkg-c", "[gipkg.descriptors]\nvery_plain = mod_c:Constant\n", mod_c=PLUGIN)
    assert "very-plain" in names("descriptor")
    assert registry.get("descriptor", "very_plain") is registry.get("descriptor", "very-plain")


def test_listing_imports_neither_plugins_nor_heavy_libraries(site: Site) -> None:
    site.install(
        "gipkg-slow",
        "[gipkg.descriptors]\nslow = mod_slow:Slow\n",
        mod_slow="raise SystemExit('the listing imported a plugin')",
    )
    code = f"""
        import sys
        sys.path.insert(0, {str(site.folder)!r})
        from gipkg import registry
        found = [ref.name for kind in registry.KINDS for ref in registry.list_plugins(kind)]
        registry.fingerprint("descriptor", "slow")
        assert "slow" in found
        heavy = {{"torch", "numpy", "scipy", "pydantic", "trimesh", "mod_slow"}} & set(sys.modules)
        assert not heavy, heavy
    """
    subprocess.run([sys.executable, "-c", dedent(code)], check=True)


def test_importing_gipkg_imports_nothing_else_of_it() -> None:
    code = """
        import sys, gipkg
        loaded = [name for name in sys.modules if name.startswith("gipkg.")]
        assert not loaded and "numpy" not in sys.modules, loaded
        assert "prepare" in dir(gipkg) and gipkg.SphericalMap.__module__ == "gipkg.api.parametrizer"
    """
    subprocess.run([sys.executable, "-c", dedent(code)], check=True)


def test_a_name_gipkg_does_not_export_is_an_attribute_error() -> None:
    import gipkg

    with pytest.raises(AttributeError, match="no attribute 'parametrise'"):
        _ = gipkg.parametrise


def test_unknown_name_suggests_and_lists(site: Site) -> None:
    site.install(
        "gipkg-c",
        "[gipkg.descriptors]\nconstant = mod_c:Constant\nold = mod_old:Old\n",
        mod_c=PLUGIN,
        mod_old="import a_library_that_is_gone",
    )
    with pytest.raises(UnknownPluginError) as caught:
        registry.get("descriptor", "constnat")
    message = str(caught.value)
    assert "did you mean 'constant'?" in message
    assert "constant (gipkg-c 0.2)" in message
    assert "No module named 'a_library_that_is_gone'" in message.partition("not loadable")[2]
    assert "\n" not in message


def test_unknown_kind_is_named_with_the_choices() -> None:
    with pytest.raises(UnknownPluginError, match=r"'descriptors'; did you mean 'descriptor'\?"):
        registry.list_plugins("descriptors")


def test_two_distributions_with_one_name_are_both_named(site: Site) -> None:
    entry = "[gipkg.descriptors]\nconstant = {}:Constant\n"
    site.install("gipkg-one", entry.format("mod_one"), mod_one=PLUGIN)
    site.install("gipkg-two", entry.format("mod_two"), mod_two=PLUGIN)
    assert names("descriptor").count("constant") == 2
    with pytest.raises(DuplicatePluginError, match=r"gipkg-one 0\.2.*gipkg-two 0\.2"):
        registry.get("descriptor", "constant")


def test_a_built_in_is_not_shadowed(site: Site) -> None:
    site.install("gipkg-c", "[gipkg.descriptors]\nhks = mod_c:Constant\n", mod_c=PLUGIN)
    with pytest.raises(DuplicatePluginError, match=r"built in.*gipkg-c"):
        registry.find("descriptor", "hks")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("import a_library_that_is_gone", "a_library_that_is_gone"),
        ("raise SystemExit(3)", "SystemExit: 3"),
        ("def Constant(): ...", "is not a class derived from gipkg.api.Descriptor"),
        ("", "has no attribute 'Constant'"),
        (PLUGIN.replace(', description="the value"', ""), r"Constant.value needs a help text"),
        (PLUGIN.replace("    citation", "    citing"), "does not set citation"),
        (PLUGIN.replace("def channels", "def names"), "does not define channels"),
    ],
)
def test_a_broken_plugin_says_why_and_harms_no_other(site: Site, text: str, reason: str) -> None:
    site.install(
        "gipkg-c",
        "[gipkg.descriptors]\nbroken = mod_broken:Constant\nfine = mod_fine:Constant\n",
        mod_broken=text,
        mod_fine=PLUGIN,
    )
    assert {"broken", "fine"} <= set(names("descriptor"))
    assert registry.get("descriptor", "fine").__name__ == "Constant"
    with pytest.raises(BrokenPluginError, match=reason):
        registry.get("descriptor", "broken")


def test_the_cause_of_a_broken_import_is_chained(site: Site) -> None:
    site.install("gipkg-c", "[gipkg.datasets]\nbad = mod_bad:Bad\n", mod_bad="1 / 0")
    with pytest.raises(BrokenPluginError) as caught:
        registry.get("dataset", "bad")
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


def test_an_ill_formed_name_is_broken(site: Site) -> None:
    site.install("gipkg-c", "[gipkg.descriptors]\nBad.Name = mod_c:Constant\n", mod_c=PLUGIN)
    with pytest.raises(BrokenPluginError, match="lower case"):
        registry.get("descriptor", "Bad.Name")


def test_strict_mode_raises_while_listing(site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gipkg.plugin_refs.BUILTINS", {kind: {} for kind in registry.KINDS})
    site.install("gipkg-c", "[gipkg.baselines]\nbad = mod_bad:Bad\n", mod_bad="1 / 0")
    monkeypatch.setenv("GIPKG_STRICT_PLUGINS", "1")
    assert registry.list_plugins("dataset") == []
    with pytest.raises(BrokenPluginError, match="ZeroDivisionError"):
        registry.list_plugins("baseline")


def test_a_local_plugin_is_one_file_and_pickles(tmp_path: Path) -> None:
    path = local_file(tmp_path)
    registry.register_local("descriptor", "my_own", f"{path}:Constant")
    registry.register_local("descriptor", "my-own", f"{path}:Constant")
    assert names("descriptor").count("my-own") == 1
    plugin = registry.create("descriptor", "my-own", {"value": 2})
    assert pickle.loads(pickle.dumps(plugin)) == plugin


@pytest.mark.parametrize(
    ("name", "target", "reason"),
    [
        ("mine", "{folder}/absent.py:Constant", "there is no file"),
        ("mine", "{folder}/mine.py", "path/file.py:Class"),
        ("Mine!", "{folder}/mine.py:Constant", "lower case"),
    ],
)
def test_an_ill_formed_local_plugin_is_refused(
    tmp_path: Path, name: str, target: str, reason: str
) -> None:
    local_file(tmp_path)
    with pytest.raises(BrokenPluginError, match=reason):
        registry.register_local("descriptor", name, target.format(folder=tmp_path))
    assert names("descriptor") == sorted(BUILTINS["descriptor"])


def test_a_local_plugin_takes_no_name_that_is_taken(tmp_path: Path) -> None:
    path = local_file(tmp_path)
    with pytest.raises(DuplicatePluginError, match=r"mine\.py.*built in"):
        registry.register_local("descriptor", "hks", f"{path}:Constant")


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"value": -1}, r"descriptor 'mine': value = -1: .*\(float, >= 0\.0; default 1\.0\)"),
        ({"valeu": 1}, r"no parameter 'valeu'; did you mean 'value'\? \(parameters: value, fla"),
        ({"flavour": "sour"}, r"flavour = 'sour': .*one of 'plain', 'sweet'"),
        ({"value": "many", "flavour": 3}, r"value = 'many'.*; flavour = 3"),
    ],
)
def test_a_wrong_parameter_is_named_with_its_bounds(
    tmp_path: Path, parameters: dict[str, object], message: str
) -> None:
    registry.register_local("descriptor", "mine", f"{local_file(tmp_path)}:Constant")
    with pytest.raises(InvalidParameterError, match=message):
        registry.create("descriptor", "mine", parameters)
