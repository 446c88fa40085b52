"""CPU seconds, distortion and flips of the built-in maps against the number of vertices.

Usage: python benchmarks/parametrize.py [MESH ...]

Without meshes it maps urchins (balls with twelve limbs) of 162 to 40,962 vertices. Set
OMP_NUM_THREADS=1 and quote ratios within one run: absolute times depend on the machine.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import trimesh

import gipkg
from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.variational.optimal_map import triangle_shapes

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.support.shapes import urchin


def meshes(paths: list[str]) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Yield the meshes named on the command line, or urchins of growing size."""
    for path in paths:
        yield Path(path).stem, gipkg.prepare(path).mesh
    if not paths:
        for subdivisions in range(2, 7):
            yield "urchin", urchin(12, 3.0, subdivisions)


def main() -> None:
    """Print one row a mesh and method."""
    for method in ("authalic", "conformal"):
        gipkg.parametrize(urchin(12, 1.0, 2), method)  # compile outside the clock
    print(f"{'mesh':16} {'V':>7} {'method':10} {'start s':>8} {'all s':>8} {'face std':>9} "
          f"{'vertex std':>10} {'δh·A':>9} {'flips':>6}")  # fmt: skip
    for name, mesh in meshes(sys.argv[1:]):
        vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
        areas, _ = triangle_shapes(vertices, faces)
        begin = time.process_time()
        embed(vertices, faces, areas * (4 * np.pi / areas.sum()))
        start = time.process_time() - begin
        for method in ("authalic", "conformal"):
            begin = time.process_time()
            spherical_map = gipkg.parametrize(mesh, method)
            total = time.process_time() - begin
            measured = gipkg.distortion(spherical_map)
            print(f"{name:16} {len(vertices):7} {method:10} {start:8.2f} {total:8.2f} "
                  f"{measured.face_std:9.4f} {measured.vertex_std:10.4f} "
                  f"{measured.variance:9.1e} {measured.flips:6}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
