"""Where a result comes from: the code, the libraries and the machine that made it."""

from __future__ import annotations

import os
import platform
import subprocess
from importlib import metadata
from pathlib import Path
from typing import Any

import gipkg

LIBRARIES = (
    "numpy",
    "scipy",
    "numba",
    "trimesh",
    "libigl",
    "cvxopt",
    "scikit-learn",
    "torch",
    "snakemake",
    "matplotlib",
    "pyvista",
    "vtk",
)
"""The libraries whose version may show in a number."""


def environment() -> dict[str, Any]:
    """Describe the running code and machine; no clock is read.

    Returns
    -------
    dict
        ``gipkg`` (version, commit, whether files differ from it), ``python``, ``libraries``
        (name to version, None where one is not installed) and ``machine``.
    """
    return {
        "gipkg": {"version": gipkg.__version__, **_checkout(Path(gipkg.__file__).parent)},
        "python": platform.python_version(),
        "libraries": {name: _version(name) for name in LIBRARIES},
        "machine": {
            "system": platform.platform(),
            "processor": _processor(),
            "cores": os.cpu_count(),
        },
    }


def _checkout(folder: Path) -> dict[str, Any]:
    """Return the commit of the working copy the package lies in; None outside of one."""
    commit = _git(folder, "rev-parse", "HEAD")
    changes = _git(folder, "status", "--porcelain", "--", ".")
    return {"commit": commit, "modified": None if commit is None else bool(changes)}


def _git(folder: Path, *arguments: str) -> str | None:
    try:
        return subprocess.run(
            ["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=True
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None  # git is not installed, or this is an installed package


def _version(name: str) -> str | None:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _processor() -> str:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:  # not Linux
        return platform.processor()
    models = [line.partition(":")[2].strip() for line in text.splitlines() if "model name" in line]
    return models[0] if models else platform.processor()
