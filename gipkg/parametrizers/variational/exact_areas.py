"""Newton projection of a spherical map onto exact vertex areas.

A map of V vertices has 2V coordinates and V vertex areas to meet, one of which follows from the
total of 4π: enough freedom to meet all of them exactly, by the least change of the map. The 2V - 4
face areas would leave none, so that face areas are kept as well as possible by the descent before.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from gipkg.cholesky import Cholesky, NotPositiveDefinite
from gipkg.errors import ParametrizationError
from gipkg.parametrizers.sphere.areas import signed_spherical_areas, triple_products
from gipkg.parametrizers.sphere.tangent import tangent_basis
from gipkg.parametrizers.variational.energy import MapEnergy

EXACT = 1e-12
"""Relative error of the vertex areas, root mean square, at which they count as exact."""
_ITERATIONS = 50
_SHORTEST_STEP = 1e-6


def project_onto_vertex_areas(
    energy: MapEnergy, sphere: NDArray[np.float64], areas: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Move a bijective map to the nearest one with exact vertex areas.

    Parameters
    ----------
    energy : MapEnergy
        Its curvature tells how far a vertex may move.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face.
    areas : (F,) float64 array
        Of the faces, summing to 4π; a third of each goes to each of its vertices.

    Returns
    -------
    (V, 3) float64 array

    Raises
    ------
    ParametrizationError
        The areas were not reached without a flip.
    """
    faces = energy.faces
    share = sp.csr_array(
        (np.full(faces.size, 1 / 3), (faces.ravel(), np.repeat(np.arange(len(faces)), 3))),
        shape=(len(sphere), len(faces)),
    )
    wanted = share @ areas

    def relative_errors(points: NDArray[np.float64]) -> NDArray[np.float64]:
        if triple_products(points, faces).min() <= 0:
            return np.full(len(points), np.inf)
        errors: NDArray[np.float64] = share @ signed_spherical_areas(points, faces) / wanted - 1
        return errors

    errors = relative_errors(sphere)
    for _ in range(_ITERATIONS):
        size = np.sqrt(np.mean(errors**2))
        if size < EXACT:
            return sphere
        try:
            step = _least_step(energy, sphere, share, wanted, errors)
        except (
            NotPositiveDefinite
        ):  # stars so thin that the areas no longer depend on the coordinates
            break
        length = 1.0
        while length > _SHORTEST_STEP:
            moved = sphere + length * step
            moved /= np.linalg.norm(moved, axis=1, keepdims=True)
            reached = relative_errors(moved)
            if np.sqrt(np.mean(reached**2)) < size * (1 - 0.1 * length):
                sphere, errors = moved, reached
                break
            length /= 2
        else:
            break
    raise ParametrizationError(
        f"exact vertex areas were not reached without a flip: the error stays at {size:.1e}; "
        "refine the mesh where it has few vertices around thin parts, or leave exact_areas off"
    )


def _least_step(
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    share: sp.csr_array,
    wanted: NDArray[np.float64],
    errors: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Find the step (V, 3) that meets the linearised areas and raises the energy least."""
    faces = energy.faces
    basis = tangent_basis(sphere)
    slopes = np.einsum("fkc,fkdc->fkd", _area_gradients(sphere, faces), basis[faces])
    columns = (2 * faces[:, :, None] + np.arange(2)).reshape(len(faces), 6)
    by_face = sp.csr_array(
        (slopes.ravel(), columns.ravel(), 6 * np.arange(len(faces) + 1)),
        shape=(len(faces), 2 * len(sphere)),
    )
    room = _vertex_room(energy, sphere, basis)
    relative = sp.diags_array(1 / wanted) @ (share @ by_face)
    # One area follows from the others, so the last equation is left out.
    system = (relative @ room @ relative.T).tocsr()[:-1, :-1]
    multipliers = np.append(Cholesky.of(system).solve(-errors[:-1]), 0.0)
    coordinates = room @ (relative.T @ multipliers)
    step: NDArray[np.float64] = np.einsum("vd,vdc->vc", coordinates.reshape(-1, 2), basis)
    return step


def _vertex_room(
    energy: MapEnergy, sphere: NDArray[np.float64], basis: NDArray[np.float64]
) -> sp.bsr_array:
    """Invert the energy's curvature vertex by vertex: little room across a thin star."""
    _, hessian, metric = energy.derivatives(sphere, basis)
    blocks = hessian + metric
    curvature = np.zeros((len(sphere), 2, 2))
    for k in range(3):
        own = blocks[:, 2 * k : 2 * k + 2, 2 * k : 2 * k + 2]
        np.add.at(curvature, energy.faces[:, k], own)
    count = np.arange(len(sphere) + 1)
    return sp.bsr_array((np.linalg.inv(curvature), count[:-1], count))


def _area_gradients(sphere: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Compute the gradient of every face's spherical area at its corners, (F, 3, 3).

    Only its tangential part is meaningful.
    """
    corners = sphere[faces]
    following, preceding = np.roll(corners, -1, axis=1), np.roll(corners, 1, axis=1)
    triple = triple_products(sphere, faces)[:, None, None]
    chords = ((following - corners) ** 2).sum(axis=(1, 2))[:, None, None]
    cosines = 4 - chords / 2
    turned = cosines * np.cross(following, preceding) - triple * (following + preceding)
    gradients: NDArray[np.float64] = 2 * turned / (cosines**2 + triple**2)
    return gradients
