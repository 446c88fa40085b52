"""Small analytic meshes that the conformance checks run on; made anew at every call."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

_LIMBS = np.array(
    [
        [0.10, 0.20, 0.97],
        [0.90, -0.30, 0.25],
        [-0.75, 0.60, 0.15],
        [-0.35, -0.85, 0.40],
        [0.40, 0.80, -0.45],
        [-0.15, -0.10, -0.98],
    ]
)
_LIMB_LENGTHS = np.array([1.6, 0.9, 1.3, 0.7, 1.1, 0.5])


def sphere(subdivisions: int = 3) -> trimesh.Trimesh:
    """Return the unit icosphere: 642 vertices at three subdivisions."""
    return trimesh.creation.icosphere(subdivisions=subdivisions)


def ellipsoid(
    axes: tuple[float, float, float] = (1.0, 1.0, 4.0), subdivisions: int = 3
) -> trimesh.Trimesh:
    """Return an icosphere stretched along the coordinate axes."""
    mesh = sphere(subdivisions)
    return mesh_of(mesh.vertices * np.asarray(axes), mesh.faces)


def limbed() -> trimesh.Trimesh:
    """Return a star-shaped body with six limbs of different lengths and no symmetry."""
    mesh = sphere()
    closeness = mesh.vertices @ (_LIMBS / np.linalg.norm(_LIMBS, axis=1, keepdims=True)).T
    radius = 1 + np.exp(14.0 * (closeness - 1)) @ _LIMB_LENGTHS
    return mesh_of(mesh.vertices * radius[:, None], mesh.faces)


def tetrahedron() -> trimesh.Trimesh:
    """Return the smallest closed mesh, an irregular one."""
    vertices = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 1.3, 0.1], [0.3, 0.4, 1.1]])
    return mesh_of(vertices, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))


def isometric_pair() -> tuple[trimesh.Trimesh, trimesh.Trimesh]:
    """Return two different surfaces with equal edge lengths: a cap out, and pushed in.

    The cap lies beyond a ring of vertices in a plane, so its mirror image fits the ring.
    """
    mesh = trimesh.creation.uv_sphere(count=[20, 20])
    vertices = np.array(mesh.vertices)
    vertices[:, 2] = vertices[:, 2].round(12)
    ring = np.unique(vertices[:, 2])[-6]
    below = np.minimum(vertices[:, 2] - ring, 0.0)
    bumps = np.sin(vertices @ np.array([2.1, 1.3, 0.7]) + 0.4)
    vertices[:, :2] *= (1 - 0.3 * below * bumps)[:, None]
    dented = vertices.copy()
    cap = vertices[:, 2] > ring
    dented[cap, 2] = 2 * ring - dented[cap, 2]
    return mesh_of(vertices, mesh.faces), mesh_of(dented, mesh.faces)


def torus() -> trimesh.Trimesh:
    """Return a closed surface of genus 1."""
    mesh = trimesh.creation.torus(major_radius=1.0, minor_radius=0.4)
    return mesh_of(mesh.vertices, mesh.faces)


def open_sphere() -> trimesh.Trimesh:
    """Return an icosphere that lacks one face."""
    mesh = sphere(2)
    return mesh_of(mesh.vertices, mesh.faces[1:])


def two_spheres() -> trimesh.Trimesh:
    """Return two separate icospheres as one mesh."""
    mesh = sphere(2)
    vertices = np.concatenate([mesh.vertices, mesh.vertices + 3.0])
    return mesh_of(vertices, np.concatenate([mesh.faces, mesh.faces + len(mesh.vertices)]))


def turned_face() -> trimesh.Trimesh:
    """Return an icosphere with one face oriented against the others."""
    mesh = sphere(2)
    faces = np.array(mesh.faces)
    faces[0] = faces[0, ::-1]
    return mesh_of(mesh.vertices, faces)


def not_finite() -> trimesh.Trimesh:
    """Return an icosphere with a vertex that is not a number."""
    mesh = sphere(2)
    vertices = np.array(mesh.vertices)
    vertices[0, 1] = np.nan
    return mesh_of(vertices, mesh.faces)


def mesh_of(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> trimesh.Trimesh:
    """Return a mesh of exactly these arrays, copied."""
    return trimesh.Trimesh(np.array(vertices), np.array(faces), process=False)


def read_only(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Return a copy whose arrays cannot be written to."""
    copy = mesh_of(mesh.vertices, mesh.faces)
    copy.vertices.flags.writeable = False
    copy.faces.flags.writeable = False
    return copy


def permuted(
    mesh: trimesh.Trimesh, rng: np.random.Generator
) -> tuple[trimesh.Trimesh, NDArray[np.int64]]:
    """Return the mesh with vertices, faces and corners in another order, and the order.

    Vertex ``order[i]`` of `mesh` is vertex ``i`` of the result.
    """
    order = rng.permutation(len(mesh.vertices))
    faces = np.argsort(order)[mesh.faces[rng.permutation(len(mesh.faces))]]
    turns = (np.arange(3) + rng.integers(3, size=(len(faces), 1))) % 3
    return mesh_of(mesh.vertices[order], np.take_along_axis(faces, turns, axis=1)), order


def moved(mesh: trimesh.Trimesh, rng: np.random.Generator) -> trimesh.Trimesh:
    """Return the mesh turned and shifted at random."""
    rotation = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    rotation *= np.linalg.det(rotation)
    return mesh_of(mesh.vertices @ rotation.T + 5 * rng.standard_normal(3), mesh.faces)


def scaled(mesh: trimesh.Trimesh, factor: float) -> trimesh.Trimesh:
    """Return the mesh with all lengths multiplied."""
    return mesh_of(mesh.vertices * factor, mesh.faces)
