"""Check every map of a finished run again: flips, degree and area distortion by method.

    python -m benchmarks.maps [RESULTS]

Signed spherical areas are computed afresh from the coordinates stored in `RESULTS` (by default
``results``).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import trimesh

import gipkg
from gipkg.shards import Shard


def main() -> None:
    """Print one row for every database and parametrizer."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", nargs="?", type=Path, default=Path("results"))
    results = parser.parse_args().results
    print(f"{'database':12} {'parametrizer':14} {'maps':>5} {'failed':>6} {'flips':>6} "
          f"{'degree error':>12} {'face std':>9} {'worst':>7} {'vertex std':>10} "
          f"{'worst':>7}")  # fmt: skip
    for folder in sorted(results.glob("parametrizers/*/*")):
        measured, failed = [], 0
        for path in sorted(folder.glob("*.npz")):
            maps = Shard.open(path)
            surfaces = Shard.open(results / "surfaces" / folder.parent.name / path.name)
            failed += len(maps.failures)
            for shape_id in maps:
                surface = surfaces[shape_id]
                mesh = trimesh.Trimesh(surface["vertices"], surface["faces"], process=False)
                spherical_map = gipkg.SphericalMap(mesh, maps[shape_id]["sphere"])
                measured.append(gipkg.distortion(spherical_map))
        if not measured:
            print(f"{folder.parent.name:12} {folder.name:14} {0:5} {failed:6}")
            continue
        faces = [one.face_std for one in measured]
        vertices = [one.vertex_std for one in measured]
        print(f"{folder.parent.name:12} {folder.name:14} {len(measured):5} {failed:6} "
              f"{sum(one.flips for one in measured):6} "
              f"{max(abs(one.degree - 1) for one in measured):12.1e} "
              f"{np.median(faces):9.4f} {max(faces):7.3f} "
              f"{np.median(vertices):10.4f} {max(vertices):7.3f}")  # fmt: skip


if __name__ == "__main__":
    main()
