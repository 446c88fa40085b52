"""The smoke run with the lowest versions that pyproject.toml allows, in an environment of its own.

    python -m benchmarks.lowest [--write] [FOLDER] [TARGET ...]

Needs Python 3.11, on which all of them have wheels. The versions are those of
constraints-lowest.txt, which --write makes of pyproject.toml; what is needed indirectly is not
held back, and torch stays at the version of constraints.txt. FOLDER is where environment and run
are made or, if they are there, gone on with; by default it is temporary.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

from packaging.requirements import Requirement

REPOSITORY = Path(__file__).resolve().parents[1]
FILE = REPOSITORY / "constraints-lowest.txt"
EXTRAS = ("learn", "figures", "workflow")
AS_PINNED = "torch"
"""Older wheels of it need other ones of CUDA, gigabytes each."""

HEADER = """\
# The lowest versions that pyproject.toml allows, for Python 3.11: python -m benchmarks.lowest
"""


def lowest() -> dict[str, str]:
    """Return the lower bound of every direct dependency of the library and the workflow."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]
    texts = [one for extra in EXTRAS for one in project["optional-dependencies"][extra]]
    versions = {}
    for requirement in map(Requirement, (*project["dependencies"], *texts)):
        if requirement.name not in ("gipkg", AS_PINNED):
            (bound,) = (one for one in requirement.specifier if one.operator == ">=")
            versions[requirement.name] = bound.version
    return dict(sorted(versions.items()))


def main() -> int:
    """Make the environment, run in it, and return the run's exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true")
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("targets", nargs="*")
    options = parser.parse_intermixed_args()
    if options.write:
        lines = (f"{name}=={version}\n" for name, version in lowest().items())
        FILE.write_text(HEADER + "".join(lines))
        return 0
    with tempfile.TemporaryDirectory(prefix="lowest-") as scratch:
        folder = (options.folder or Path(scratch)).resolve()
        if not (folder / "bin/python").exists():
            install(folder)
        return run(folder, folder / "run", options.targets)


def install(folder: Path) -> None:
    """Make an environment with the lowest versions."""
    venv.create(folder, with_pip=True)
    pinned = REPOSITORY / "constraints.txt"
    (torch,) = (
        line for line in pinned.read_text().splitlines() if line.startswith(f"{AS_PINNED}==")
    )
    pip = (folder / "bin/python", "-m", "pip", "install", "--quiet")
    subprocess.run([*pip, "-c", FILE, torch, "-e", f"{REPOSITORY}[workflow]"], check=True)


def run(folder: Path, workdir: Path, targets: list[str]) -> int:
    """Run the smoke configuration, or what it takes for some targets."""
    workdir.mkdir(exist_ok=True)
    command = [
        *(folder / "bin/python", "-m", "snakemake", "--snakefile", REPOSITORY / "Snakefile"),
        *("--directory", workdir, "--cores", "2", *targets),
        *("--configfile", REPOSITORY / "config" / "smoke.yaml"),
    ]
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(command, env={**os.environ, "PATH": path}, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
