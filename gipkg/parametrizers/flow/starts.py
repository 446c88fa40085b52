"""Bijective maps to start a flow from, near to the authalic map and far from it."""

from __future__ import annotations

from typing import Literal

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.sphere.bijectivity import require_bijective
from gipkg.surfaces.areas import face_areas

Start = Literal["hierarchy", "uniform", "squeezed", "conformal"]

_SQUEEZE = np.array([1.0, 1.0, 1 / 3])
"""Makes areas at the poles of the sphere and at its equator differ by a factor of 27."""


def start_map(mesh: trimesh.Trimesh, start: Start) -> NDArray[np.float64]:
    """Map a closed genus-0 mesh to the sphere in one of several ways, all bijective.

    ``hierarchy`` embeds the mesh coarse to fine with room for every face's area; ``uniform``
    does so with the same room for every face, however large it is; ``squeezed`` is ``hierarchy``
    after a linear map of space, projected back to the sphere, which keeps great circles and so
    flips nothing; ``conformal`` is the parametrizer of that name.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented, of genus 0, with V vertices.
    start : str

    Returns
    -------
    (V, 3) float64 array
        Unit vectors.

    Raises
    ------
    ParametrizationError
        No bijective map was found in double precision.
    """
    if start == "conformal":
        from gipkg.parametrizers.conformal import Conformal

        return Conformal.model_validate({}).parametrize(mesh)
    vertices = np.asarray(mesh.vertices, np.float64)
    faces = np.asarray(mesh.faces, np.int64)
    areas = np.ones(len(faces)) if start == "uniform" else face_areas(vertices, faces)
    sphere = embed(vertices, faces, areas * (4 * np.pi / areas.sum()))
    if start == "squeezed":
        sphere *= _SQUEEZE
        sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
        require_bijective(sphere, faces, "start from 'hierarchy', which has room for all faces")
    return sphere
