"""CPU seconds, iterations, distortion and flips of a map against the number of vertices.

    python -m benchmarks.parametrize [--method METHOD] [--set NAME=VALUE ...] [MESH ...]

Without meshes it maps urchins (balls with twelve limbs) of 642 to 163,842 vertices and ends with
the growth exponent. The columns on the right say where the time went. Set OMP_NUM_THREADS=1 and
quote ratios within one run: absolute times depend on the machine.
"""

from __future__ import annotations

import argparse
import cProfile
import pstats
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import trimesh

import gipkg
from tests.support.shapes import urchin

STEPS = {
    "order": "canonical_order",
    "start": "embed",
    "system": "derivatives",
    "gather": "_gather",
    "analyse": "<built-in method cvxopt.cholmod.symbolic>",
    "factorize": "<built-in method cvxopt.cholmod.numeric>",
    "solve": "<built-in method cvxopt.cholmod.solve>",
    "value": "value",
}
"""Heading -> function whose cumulative time stands under it."""


def meshes(paths: list[str]) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Yield the meshes named on the command line, or urchins of growing size."""
    for path in paths:
        yield Path(path).stem, gipkg.prepare(path).mesh
    if not paths:
        for subdivisions in range(3, 8):
            yield "urchin", urchin(12, 3.0, subdivisions)


def parameter(text: str) -> tuple[str, float | bool]:
    """Read ``NAME=VALUE``."""
    name, given = text.split("=")
    if given in ("true", "false"):
        return name, given == "true"
    return name, int(given) if given.isdigit() else float(given)


def spent(profile: cProfile.Profile, function: str) -> float:
    """Cumulative seconds of all functions of that name."""
    rows = pstats.Stats(profile).stats.items()  # type: ignore[attr-defined]
    return sum(row[3] for (_, _, name), row in rows if name == function)


def main() -> None:
    """Print one row a mesh, where the time went, and how it grows."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--method", default="authalic")
    parser.add_argument("--set", nargs="*", default=[], metavar="NAME=VALUE")
    parser.add_argument("meshes", nargs="*")
    chosen = parser.parse_args()
    parameters = dict(map(parameter, chosen.set))
    gipkg.parametrize(urchin(12, 1.0, 2), chosen.method, **parameters)  # compile first
    print(f"{'mesh':16} {'V':>7} {'CPU s':>8} {'steps':>5} {'face std':>9} {'vertex std':>10} "
          f"{'δh·A':>8} {'flips':>5}   {' '.join(f'{name:>9}' for name in STEPS)}")  # fmt: skip
    sizes, seconds = [], []
    for name, mesh in meshes(chosen.meshes):
        told: list[int] = []
        profile = cProfile.Profile(time.process_time)
        begin = time.process_time()
        spherical_map = profile.runcall(
            gipkg.parametrize,
            mesh,
            chosen.method,
            callback=lambda iteration, told=told: told.append(iteration.number),
            **parameters,
        )
        total = time.process_time() - begin
        measured = gipkg.distortion(spherical_map)
        where = " ".join(f"{spent(profile, step):9.2f}" for step in STEPS.values())
        print(f"{name:16} {len(mesh.vertices):7} {total:8.2f} {max(told, default=0):5} "
              f"{measured.face_std:9.5f} {measured.vertex_std:10.1e} {measured.variance:8.1e} "
              f"{measured.flips:5}   {where}", flush=True)  # fmt: skip
        sizes.append(len(mesh.vertices))
        seconds.append(total)
    if len(sizes) > 1 and not chosen.meshes:
        exponent = np.polyfit(np.log(sizes), np.log(seconds), 1)[0]
        print(f"CPU time grows with the vertices to the power {exponent:.2f}")


if __name__ == "__main__":
    main()
