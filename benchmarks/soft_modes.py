"""What the area errors of faces are made of where a descent ends.

    python -m benchmarks.soft_modes FILE ... [--rounds N]

2V - 5 face areas meet 2V - 3 degrees of freedom. The singular values of the relative areas' slopes
say which patterns of errors a small move can mend, in units in which every vertex alone changes the
areas around it by 1. Printed for each mesh: the softest values, how much of the squared error the
softest patterns hold, how many faces wide such a pattern is (the inverse of the sum of its fourth
powers), how much the ten worst faces hold, and how errors of neighbours correlate (-1/2: too large
beside too small).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import eigsh

import gipkg
from gipkg.parametrizers.sphere.areas import area_gradients
from gipkg.parametrizers.sphere.tangent import tangent_basis
from gipkg.surfaces.halfedges import twins

PATTERNS, WORST = 60, 10


def main() -> None:
    """Print a row a mesh."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", type=Path, nargs="+")
    parser.add_argument("--rounds", type=int, default=0, help="of `authalic`; 0 unless given")
    arguments = parser.parse_args()
    for path in arguments.files:
        mesh = gipkg.prepare(path).mesh
        settings = {
            "shape_weight": 1e-7,
            "tolerance": 1e-5,
            "max_iterations": 400,
            "face_tolerance": 1e-3,
        }
        spherical_map = gipkg.parametrize(mesh, **settings, rounds=arguments.rounds)
        print(f"{path.name} ({len(mesh.vertices)} vertices): {report(spherical_map)}", flush=True)


def report(spherical_map: gipkg.SphericalMap) -> str:
    """Say what the errors of a map are made of."""
    faces = np.asarray(spherical_map.mesh.faces, np.int64)
    found = gipkg.distortion(spherical_map)
    errors = found.spherical_areas / found.mesh_areas - 1
    errors -= errors.mean()
    values, patterns = softest(spherical_map.sphere, faces, found.mesh_areas)
    share = ((patterns.T @ errors) ** 2).sum() / (errors @ errors)
    worst = np.sort(errors**2)[-WORST:].sum() / (errors @ errors)
    widths = 1 / (patterns**4).sum(axis=0)
    across = errors[twins(faces) // 3]  # in the order of the half-edges, three a face
    return (
        f"face std {found.face_std:.4f}, softest values {values[[2, 10, 30, -1]]}, "
        f"{share:.0%} of the squared error in {PATTERNS} of {len(faces)} patterns, "
        f"{np.median(widths):.0f} faces wide, {worst:.0%} in {WORST} faces, "
        f"neighbours correlate {np.corrcoef(np.repeat(errors, 3), across)[0, 1]:.2f}"
    )


def softest(
    sphere: NDArray[np.float64], faces: NDArray[np.int64], areas: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the least singular values (K,) and their patterns of errors (F, K)."""
    slopes = np.einsum("fkc,fkdc->fkd", area_gradients(sphere, faces), tangent_basis(sphere)[faces])
    slopes /= areas[:, None, None]
    weights = np.bincount(faces.ravel(), (slopes**2).sum(axis=2).ravel())
    slopes /= np.sqrt(weights)[faces][:, :, None]
    columns = 2 * faces[:, :, None] + np.arange(2)
    by_face = sp.csr_array(
        (slopes.ravel(), columns.ravel(), 6 * np.arange(len(faces) + 1)),
        shape=(len(faces), 2 * len(sphere)),
    )
    # The total area is fixed, so that one value is zero: the small term keeps the matrix regular.
    squares = (by_face @ by_face.T + 1e-14 * sp.eye_array(len(faces))).tocsc()
    values, patterns = eigsh(squares, k=PATTERNS, sigma=0, which="LM")
    order = values.argsort()
    return np.sqrt(np.maximum(values[order], 0)), patterns[:, order]


if __name__ == "__main__":
    main()
