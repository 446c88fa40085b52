"""What a difference in the last bit of the coordinates becomes in each stage.

    python -m benchmarks.last_bit FILE ...

Another machine or library rounds differently; how much of that can be seen is what the stages make
of it. Every coordinate of each mesh moves by up to one unit in its last place, and what comes out
is compared with what came out before: largest differences, over three such moves.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

import gipkg
from gipkg.descriptors.operators import Operators

EIGENPAIRS = 60


def main() -> None:
    """Print a row a mesh."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", type=Path, nargs="+")
    for number, path in enumerate(parser.parse_args().files):
        mesh = gipkg.prepare(path).mesh
        expected = stages(mesh)
        rng = np.random.default_rng(number)
        worst = dict.fromkeys(expected, 0.0)
        for _ in range(3):
            steps = rng.integers(-1, 2, mesh.vertices.shape)
            moved = mesh.vertices + steps * np.spacing(mesh.vertices)
            found = stages(trimesh.Trimesh(moved, mesh.faces, process=False))
            for name, array in expected.items():
                worst[name] = max(worst[name], float(np.abs(found[name] - array).max()))
        said = ", ".join(f"{name} {value:.1e}" for name, value in worst.items())
        print(f"{path.name} ({len(mesh.vertices)} vertices): {said}", flush=True)


def stages(mesh: trimesh.Trimesh) -> Mapping[str, NDArray[np.floating]]:
    """Return what the stages make of a surface, each in units of its own range."""
    plain = gipkg.parametrize(mesh)
    freed = gipkg.parametrize(mesh, shape_weight=1e-7, rounds=3, face_tolerance=1e-3)
    exact = gipkg.parametrize(mesh, exact_areas=True)
    values = Operators(mesh, EIGENPAIRS).spectrum.eigenvalues
    signature = gipkg.describe(mesh, "hks", times=5)
    image = gipkg.geometry_image(plain, signature, size=56)
    return {
        "map": plain.sphere,
        "map after rounds": freed.sphere,
        "map with exact areas": exact.sphere,
        "eigenvalues": values / values[-1],
        "HKS": signature / np.ptp(signature, axis=0),
        "image": image / np.ptp(image, axis=(1, 2))[:, None, None],
    }


if __name__ == "__main__":
    main()
