from __future__ import annotations

import importlib.metadata
import json
import subprocess
from pathlib import Path

import pytest

import gipkg
from gipkg.reporting import provenance


def test_the_environment_is_that_of_this_process_and_plain_json() -> None:
    environment = provenance.environment()
    assert environment["gipkg"]["version"] == gipkg.__version__
    for name in ("numpy", "scipy", "trimesh"):
        assert environment["libraries"][name] == importlib.metadata.version(name)
    assert environment["machine"]["processor"]
    assert json.loads(json.dumps(environment)) == environment
    assert environment == provenance.environment()


def test_commit_and_changes_of_a_working_copy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "gipkg"
    package.mkdir()
    (package / "__init__.py").write_text("")
    # Asked about another folder, the module must not answer for this repository.
    monkeypatch.setattr(gipkg, "__file__", str(package / "__init__.py"))
    assert checkout() == {"commit": None, "modified": None}

    git = ["git", "-C", str(tmp_path), "-c", "user.name=x", "-c", "user.email=x@localhost"]
    subprocess.run([*git, "init", "--quiet"], check=True)
    subprocess.run([*git, "add", "."], check=True)
    subprocess.run([*git, "commit", "--quiet", "-m", "first"], check=True)
    head = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=True)
    assert checkout() == {"commit": head.stdout.strip(), "modified": False}
    (package / "__init__.py").write_text("edited = True")
    assert checkout() == {"commit": head.stdout.strip(), "modified": True}


def checkout() -> dict[str, object]:
    found = dict(provenance.environment()["gipkg"])
    del found["version"]
    return found
