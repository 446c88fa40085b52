"""Compiled code follows edits wherever they are made."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import gipkg

CALLEE = """
from gipkg.compilation import compiled

@compiled
def unit():
    return {value}
"""
CALLER = """
from gipkg.callee import unit
from gipkg.compilation import compiled

@compiled
def double():
    return 2 * unit()
"""


def _run(folder: Path, code: str) -> str:
    variables = {"PYTHONPATH": str(folder), "XDG_CACHE_HOME": str(folder / "cache")}
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | variables,
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


def test_an_edited_callee_in_another_file_is_compiled_again(tmp_path: Path) -> None:
    package = tmp_path / "gipkg"
    package.mkdir()
    for name in ("__init__.py", "compilation.py"):
        shutil.copy(Path(gipkg.__file__).with_name(name), package)
    (package / "caller.py").write_text(CALLER)
    (package / "unrelated.py").write_text("")
    double = "from gipkg.caller import double; print(double())"
    folder = "from gipkg.compilation import _cache_folder as f; print(f())"

    (package / "callee.py").write_text(CALLEE.format(value=1))
    assert _run(tmp_path, double) == "2"
    before = _run(tmp_path, folder)
    assert list(Path(before).rglob("*.nbc")), "nothing was kept"
    (package / "unrelated.py").write_text("changed = True")
    assert _run(tmp_path, folder) == before

    (package / "callee.py").write_text(CALLEE.format(value=3))
    assert _run(tmp_path, double) == "6"
