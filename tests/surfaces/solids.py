"""Surfaces with known topology, defects to put into them, and an independent check."""

from __future__ import annotations

import networkx
import numpy as np
import trimesh


def bare(vertices, faces) -> trimesh.Trimesh:
    return trimesh.Trimesh(vertices, faces, process=False)


def sphere(subdivisions: int = 2) -> trimesh.Trimesh:
    ball = trimesh.creation.icosphere(subdivisions)
    return bare(ball.vertices, ball.faces)


def torus(around: int = 24, across: int = 12, minor: float = 0.3) -> trimesh.Trimesh:
    """A ring of radius 1 about the z axis, regular and closed by its indices."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = 2 * np.pi * u.ravel() / around, 2 * np.pi * v.ravel() / across
    ring = 1 + minor * np.cos(b)
    vertices = np.column_stack((ring * np.cos(a), ring * np.sin(a), minor * np.sin(b)))

    def at(i, j):
        return ((i % around) * across + j % across).ravel()

    quads = np.column_stack((at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)))
    return bare(vertices, np.concatenate((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]])))


def glued(one: trimesh.Trimesh, two: trimesh.Trimesh, face_one: int, face_two: int):
    """Join two closed surfaces by a tube between a face of each: their genera add up."""
    shift = len(one.vertices)
    a, b = one.faces[face_one], two.faces[face_two][::-1] + shift
    points = np.concatenate((one.vertices, two.vertices))
    turns = [np.linalg.norm(points[a] - points[np.roll(b, k)], axis=1).sum() for k in range(3)]
    b = np.roll(b, int(np.argmin(turns)))
    tube = []
    for k in range(3):
        p, q = k, (k + 1) % 3
        tube += [(a[p], a[q], b[q]), (a[p], b[q], b[p])]
    faces = np.concatenate(
        (np.delete(one.faces, face_one, 0), np.delete(two.faces, face_two, 0) + shift, tube)
    )
    return bare(points, faces)


def chain_of_tori(count: int) -> trimesh.Trimesh:
    """Tori side by side along x, glued to a surface of genus `count`."""
    chain = torus()
    for k in range(1, count):
        link = torus()
        link.apply_translation((3.0 * k, 0, 0))
        right = int(np.argmax(chain.triangles_center[:, 0]))
        left = int(np.argmin(link.triangles_center[:, 0]))
        chain = glued(chain, link, right, left)
    return chain


def moebius_strip(length: int = 30) -> trimesh.Trimesh:
    a = 2 * np.pi * np.arange(length) / length
    vertices = []
    for side in (-0.3, 0.3):
        ring = 1 + side * np.cos(a / 2)
        vertices.append(np.column_stack((ring * np.cos(a), ring * np.sin(a), side * np.sin(a / 2))))
    faces = []
    for i in range(length):
        low, high = i, length + i
        next_low, next_high = (i + 1, length + i + 1) if i + 1 < length else (length, 0)
        faces += [(low, next_low, next_high), (low, next_high, high)]
    return bare(np.concatenate(vertices), np.array(faces))


def soup(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The same triangles, no two of them sharing a vertex."""
    corners = mesh.vertices[mesh.faces].reshape(-1, 3)
    return bare(corners, np.arange(len(corners)).reshape(-1, 3))


def without_cap(mesh: trimesh.Trimesh, height: float) -> trimesh.Trimesh:
    """The faces below a height."""
    return bare(mesh.vertices, mesh.faces[mesh.triangles_center[:, 2] < height])


def assert_genus_zero(mesh: trimesh.Trimesh) -> None:
    """By trimesh, NetworkX and counting, none of which the stage itself uses."""
    faces = np.asarray(mesh.faces)
    assert np.isfinite(mesh.vertices).all()
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.body_count == 1
    assert mesh.volume > 0
    assert mesh.area_faces.min() > 0
    assert sorted(np.unique(faces)) == list(range(len(mesh.vertices)))
    edges = {frozenset((face[k - 1], face[k])) for face in faces.tolist() for k in range(3)}
    assert len(mesh.vertices) - len(edges) + len(faces) == 2
    assert_manifold_vertices(faces)


def assert_manifold_vertices(faces: np.ndarray) -> None:
    """The edges opposite to a vertex form one closed ring around it."""
    links: dict[int, networkx.Graph] = {}
    for face in faces.tolist():
        for k in range(3):
            links.setdefault(face[k], networkx.Graph()).add_edge(face[k - 2], face[k - 1])
    for link in links.values():
        assert networkx.is_connected(link)
        assert all(degree == 2 for _, degree in link.degree)
