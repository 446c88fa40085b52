"""A second pose of a shape: its limbs bent, with as little stretching as can be."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from gipkg.errors import UnsupportedMesh
from gipkg.reporting.tips import limb_tips, vertex_shares

_REST = 0.2
"""Share of the area around the middle that keeps its place."""
_JOINT = 0.5
"""How far out on its limb, from the middle to its end, a joint is."""
_ROUNDS = 200
"""Of the minimisation; more change nothing that is seen."""


def bend(mesh: trimesh.Trimesh, towards: ArrayLike, angle: float) -> trimesh.Trimesh:
    """Bend all limbs of a shape to one side.

    The ends of the limbs are turned about joints, what is around the middle of the shape stays,
    and what is between follows as rigidly as possible (O. Sorkine & M. Alexa,
    As-Rigid-As-Possible Surface Modeling, SGP 2007).

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, of one component, with limbs; V vertices.
    towards : (3,) array_like
        Direction that the limbs turn to.
    angle : float
        Of the turn, in radians.

    Returns
    -------
    trimesh.Trimesh
        The same vertices, in order, elsewhere.

    Raises
    ------
    UnsupportedMesh
        The shape has no limbs.
    """
    import igl

    tips = limb_tips(mesh)
    if not len(tips.vertex):
        raise UnsupportedMesh("the shape has no limbs to bend: name one with limbs")
    vertices = np.array(mesh.vertices, dtype=np.float64)
    middle = vertex_shares(mesh) @ vertices
    targets = vertices.copy()
    for tip, end in enumerate(tips.vertex):
        axis = np.cross(vertices[end] - middle, np.asarray(towards, dtype=np.float64))
        turn = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis))
        joint = middle + _JOINT * (vertices[end] - middle)
        moved = tips.region == tip
        targets[moved] = turn.apply(vertices[moved] - joint) + joint
    held = np.flatnonzero((tips.region >= 0) | _around(mesh, middle))
    data = igl.ARAPData()
    data.max_iter = _ROUNDS
    faces = np.asarray(mesh.faces, dtype=np.int64)
    igl.arap_precomputation(vertices, faces, 3, held.astype(np.int32), data)
    return trimesh.Trimesh(igl.arap_solve(targets[held], data, vertices), faces, process=False)


def stretching(mesh: trimesh.Trimesh, other: trimesh.Trimesh) -> float:
    """Return the root mean square change of the edges' lengths, as a share of their lengths."""
    edges = np.asarray(mesh.edges_unique)
    before, after = (
        np.linalg.norm(np.subtract(*np.asarray(one.vertices)[edges.T]), axis=1)
        for one in (mesh, other)
    )
    return float(np.sqrt(((after - before) ** 2).sum() / (before**2).sum()))


def _around(mesh: trimesh.Trimesh, point: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which vertices (V,) are nearest to a point, up to a share of the area."""
    order = np.argsort(np.linalg.norm(np.asarray(mesh.vertices) - point, axis=1), kind="stable")
    inside = np.zeros(len(order), dtype=bool)
    inside[order[np.cumsum(vertex_shares(mesh)[order]) <= _REST]] = True
    return inside
