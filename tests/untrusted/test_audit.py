"""No call that runs what data say, or that writes where data say, is anywhere in the code."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from tests.workflow.workdir import REPOSITORY

FILES = sorted(path for name in ("gipkg", "workflow") for path in (REPOSITORY / name).rglob("*.py"))

REQUIRED = {
    ("np", "load"): "allow_pickle=False",
    ("numpy", "load"): "allow_pickle=False",
    ("np", "save"): "allow_pickle=False",
    ("torch", "load"): "weights_only=True",
}
"""Calls that have to say that they want no pickles."""

FORBIDDEN_MODULES = {"shelve", "marshal", "joblib", "cloudpickle", "dill", "urllib.request"}
FORBIDDEN = {
    *{
        "eval",
        "exec",
        "compile",
        "__import__",
        "os.system",
        "os.popen",
        "yaml.load",
        "tempfile.mktemp",
    },
    *{"shutil.unpack_archive", "urlopen", "urlretrieve", "pickle.load", "np.savez"},
    *{"trimesh.load", "trimesh.load_mesh", "trimesh.load_scene", "trimesh.load_remote"},
    "np.savez_compressed",
}
FORBIDDEN_METHODS = {"extractall", "extract"}
ALLOWED = {
    "pickle.loads": "gipkg/testing/common.py",  # of what it has pickled itself, a plugin
    "Markup": "gipkg/reporting/page/html.py",  # our own scripts and styles
}
"""Calls that are dangerous in general, and the one file where each is not."""


def calls(path: Path) -> Iterator[tuple[str, ast.Call]]:
    """Yield the calls in a file with their dotted names."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            yield ast.unparse(node.func), node


def faults(path: Path) -> Iterator[str]:
    """Yield the calls of a file that trust what they are given."""
    place = path.relative_to(REPOSITORY).as_posix()
    for name, call in calls(path):
        keywords = {f"{one.arg}={ast.unparse(one.value)}" for one in call.keywords}
        trusting = (
            REQUIRED.get(tuple(name.split(".")), next(iter(keywords), None))
            not in {*keywords, None}
            or "shell=True" in keywords
            or name in FORBIDDEN
            or name.rpartition(".")[2] in FORBIDDEN_METHODS
            or ALLOWED.get(name, place) != place
        )
        if trusting:
            yield f"{place}:{call.lineno}: {name}"


def test_no_call_trusts_data() -> None:
    assert [fault for path in FILES for fault in faults(path)] == []


def test_no_module_that_unpickles_is_imported() -> None:
    imported = {
        (path.name, alias.name)
        for path in FILES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    assert not [one for one in imported if one[1] in FORBIDDEN_MODULES]


def test_the_audit_sees_what_it_is_for() -> None:
    assert len(FILES) > 200
    seen = {name for path in FILES for name, _ in calls(path)}
    assert {"np.load", "torch.load", "np.save", "Markup"} <= seen


def test_templates_escape_and_include_no_raw_text() -> None:
    for template in (REPOSITORY / "gipkg").rglob("*.j2"):
        text = template.read_text(encoding="utf-8")
        assert "|safe" not in text.replace(" ", "")
        assert "autoescape" not in text
