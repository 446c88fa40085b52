"""Where the paper's flow and Lie advection end, from several starts and as printed.

    python -m benchmarks.flow_starts MESH|DATABASE:SHAPE ...

``tosca:wolf0`` or ``tosca-highres:david0`` are taken from the data root, GIPKG_DATA_ROOT or
``data``. Meshes are prepared first. Set OMP_NUM_THREADS=1.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import trimesh

import gipkg
from gipkg import registry
from gipkg.parametrizers.flow.starts import Start, start_map

PRINTED = {"step": 0.01, "right_hand_side": "ratio", "guard": False}
"""The paper's step and right-hand side, with nothing to hold the vertices."""
VARIANTS: list[tuple[str, dict[str, Any]]] = [
    ("ρ = 0.01", {"step": 0.01}),
    ("rank 300", {"rank": 300}),
    ("no guard, ρ = 0.01", {"step": 0.01, "guard": False}),
    ("no guard, ρ = 0.05", {"step": 0.05, "guard": False}),
    ("as printed", PRINTED),
    ("as printed, ρ = 1e-4", {**PRINTED, "step": 1e-4}),
    ("as printed, rank 300", {**PRINTED, "rank": 300}),
]


def meshes(arguments: list[str]) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Yield the surfaces named on the command line."""
    root = Path(os.environ.get("GIPKG_DATA_ROOT", "data"))
    for argument in arguments:
        database, _, shape = argument.partition(":")
        if shape:
            mesh = registry.create("dataset", database, {}).load(root, shape)
            yield shape, gipkg.prepare(mesh).mesh
        else:
            yield Path(argument).stem, gipkg.prepare(argument).mesh


def runs() -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Yield a label, a method and its parameters for every row of a mesh."""
    for start in get_args(Start):
        yield f"flow from {start}", "authalic-flow", {"start": start}
    for label, parameters in VARIANTS:
        yield f"flow, {label}", "authalic-flow", parameters
    for start in get_args(Start):
        yield f"Lie from {start}", "lie-advection", {"start": start}


def row(label: str, mesh: trimesh.Trimesh, sphere: np.ndarray, seconds: float, steps: int) -> str:
    """Measure a map."""
    measured = gipkg.distortion(gipkg.SphericalMap(mesh, sphere))
    return (
        f"  {label:30} {seconds / max(steps, 1):8.3f} {steps:5} {measured.face_std:9.4f} "
        f"{measured.vertex_std:10.4f} {measured.variance:9.2e} {measured.flips:6}"
    )


def main() -> None:
    """Print, for every mesh, the starts and where each run ends."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="+", metavar="MESH|DATABASE:SHAPE")
    for name, mesh in meshes(parser.parse_args().meshes):
        print(f"{name}, {len(mesh.vertices)} vertices")
        print(f"  {'':30} {'s/step':>8} {'steps':>5} {'face std':>9} {'vertex std':>10} "
              f"{'δh·A':>9} {'flips':>6}")  # fmt: skip
        for start in get_args(Start):
            begin = time.process_time()
            sphere = start_map(mesh, start)
            print(row(f"start: {start}", mesh, sphere, time.process_time() - begin, 0))
        for label, method, parameters in runs():
            # The clock runs from the start map on.
            clock: list[float] = []
            sphere = gipkg.parametrize(
                mesh,
                method,
                callback=lambda _, c=clock: c.append(time.process_time()),
                **parameters,
            ).sphere
            print(row(label, mesh, sphere, clock[-1] - clock[0], len(clock) - 1), flush=True)


if __name__ == "__main__":
    main()
