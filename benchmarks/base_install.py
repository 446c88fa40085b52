"""The wheel in an environment of its own, with nothing but what the base install needs.

Builds the wheel, installs it with pip (from the configured index) beside nothing else, and goes
from a mesh to a mesh by the command line.

    python -m benchmarks.base_install [--constraint constraints.txt] [FOLDER]

FOLDER is where the environment is made; it must not exist. By default it is temporary.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]

EXTRAS = ("torch", "snakemake", "pyvista", "vtk", "matplotlib", "yaml", "jsonschema")

MAKE_MESH = (
    "import trimesh; mesh = trimesh.creation.icosphere(3); mesh.apply_scale([1, 0.8, 1.7]); "
    "trimesh.Trimesh(mesh.vertices, mesh.faces[20:]).export('egg.obj')"
)
MEASURE = (
    "import trimesh; from gipkg.evaluation.surface_distance import surface_distance; "
    "before, after = (trimesh.load(f) for f in ('closed/egg.ply', 'again/egg.ply')); "
    "assert after.is_watertight; print(surface_distance(before, after))"
)
STEPS = (
    ("prepare", "egg.obj", "-o", "closed"),
    ("parametrize", "closed/egg.ply", "-o", "maps"),
    ("image", "maps/egg.npz", "-o", "images"),
    ("reconstruct", "images/egg.npy", "-o", "again"),
    ("distort", "maps/egg.npz", "--json"),
    ("plugins", "doctor"),
)


def main() -> None:
    """Install and try; any step that fails ends with its exit code."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("--constraint", type=Path, help="Constraints file for pip.")
    arguments.add_argument("folder", nargs="?", type=Path)
    chosen = arguments.parse_args()
    if chosen.folder is not None:
        chosen.folder.mkdir(parents=True)
        measure(chosen.folder.resolve(), chosen.constraint)
        return
    with tempfile.TemporaryDirectory() as folder:
        measure(Path(folder), chosen.constraint)


def measure(folder: Path, constraint: Path | None) -> None:
    """Make the environment in a folder, and run every step in it."""
    pip = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
    timed("build", *pip, "wheel", "--no-deps", "--wheel-dir", folder, REPOSITORY)
    (wheel,) = folder.glob("*.whl")
    venv.create(folder / "venv", with_pip=True)
    python, gipkg = (folder / "venv" / "bin" / name for name in ("python", "gipkg"))
    pinned = ("--constraint", constraint.resolve()) if constraint else ()
    timed("install", python, *pip[1:], "install", *pinned, wheel)
    absent = "from importlib.util import find_spec as f; import sys; sys.exit(any(map(f, {!r})))"
    timed("no extra is there", python, "-c", absent.format(EXTRAS), folder=folder)
    timed("import gipkg", python, "-c", "import gipkg", folder=folder)
    timed("make a mesh", python, "-c", MAKE_MESH, folder=folder)
    for step in STEPS:
        timed(" ".join(step[:2]), gipkg, *step, folder=folder)
    timed("compare", python, "-c", MEASURE, folder=folder)


def timed(label: str, *command: object, folder: Path | None = None) -> None:
    """Run a command, and print what it took and what it said last."""
    own = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    began = time.perf_counter()
    run = subprocess.run(
        list(map(str, command)), cwd=folder, env=own, capture_output=True, text=True, check=False
    )
    seconds = time.perf_counter() - began
    last = run.stdout.strip().rpartition("\n")[2]
    print(json.dumps({"step": label, "seconds": round(seconds, 2), "said": last}), flush=True)
    if run.returncode:
        sys.exit(f"{label} ended with {run.returncode}:\n{run.stdout}{run.stderr}")


if __name__ == "__main__":
    main()
