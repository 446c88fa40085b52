from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.surfaces.areas import face_areas
from gipkg.surfaces.slivers import SLIVER, Resolved, resolve_slivers
from gipkg.surfaces.triangles import Triangles
from tests.surfaces.solids import assert_genus_zero, bare, sphere
from tests.surfaces.test_steps import triangles


def least_area_share(mesh: Triangles) -> float:
    area = face_areas(mesh.vertices, mesh.faces)
    return float(area.min() / area.mean())


def with_split_edge(edge: int, at: float) -> Triangles:
    """A sphere with a vertex in an edge, joined to one of its faces only as a flat corner."""
    ball = triangles(sphere())
    face = ball.faces[edge // 3]
    a, b, c = np.roll(face, -(edge % 3))
    point = (1 - at) * ball.vertices[a] + at * ball.vertices[b]
    middle = len(ball.vertices)
    faces = np.delete(ball.faces, edge // 3, axis=0)
    added = np.array([[a, middle, c], [middle, b, c], [a, b, middle]])
    return ball.with_faces(faces).append(point[None], added)


def test_good_mesh_is_left_alone():
    ball = triangles(sphere())
    assert resolve_slivers(ball) == (ball, Resolved())


@settings(max_examples=20)
@given(st.integers(0, 959), st.floats(0.05, 0.95))
def test_flat_corner_is_flipped_in_place(edge, at):
    flat = with_split_edge(edge, at)
    assert least_area_share(flat) < 1e-12
    resolved, how = resolve_slivers(flat)
    assert (how.collapsed, how.flipped, how.nudged) == (0, 1, 0)
    assert np.array_equal(resolved.vertices, flat.vertices)
    assert least_area_share(resolved) > SLIVER
    assert_genus_zero(bare(resolved.vertices, resolved.faces))


@settings(max_examples=20)
@given(st.integers(0, 959), st.sampled_from([0.0, 1e-14, 1e-9]))
def test_needle_is_collapsed(edge, at):
    needle = with_split_edge(edge, at)
    resolved, how = resolve_slivers(needle)
    assert how.collapsed == 1
    assert least_area_share(resolved) > SLIVER
    mesh = bare(resolved.vertices, resolved.faces)
    assert_genus_zero(mesh)
    assert len(mesh.faces) == len(sphere().faces)


def test_original_vertex_survives_the_collapse_with_an_added_one():
    needle = with_split_edge(10, 0.0)
    resolved, _ = resolve_slivers(needle)
    assert resolved.original.all()
    assert np.array_equal(resolved.vertices, sphere().vertices)


def test_what_can_neither_flip_nor_collapse_is_nudged():
    """A tetrahedron without height: collapsing it would leave no surface at all."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0.3, 0, 0], [0.6, 0, 0.0]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    flat = Triangles(corners, faces, np.ones(4, bool))
    area = face_areas(corners, faces)
    assert area.max() == 0
    resolved, how = resolve_slivers(flat)
    assert how.nudged == 4
    assert face_areas(resolved.vertices, resolved.faces).min() > 0
    assert np.abs(resolved.vertices - corners).max() < 1e-2


@pytest.mark.parametrize("seed", range(3))
def test_many_slivers_at_once(seed):
    random = np.random.default_rng(seed)
    ball = triangles(sphere(3))
    vertices = ball.vertices.copy()
    for face in random.choice(len(ball.faces), 40, replace=False):
        a, b, c = ball.faces[face]
        weight = random.uniform(0, 1) if random.uniform() < 0.5 else 0.0
        vertices[c] = (1 - weight) * vertices[a] + weight * vertices[b]
    flat = Triangles(vertices, ball.faces, ball.original)
    resolved, how = resolve_slivers(flat)
    assert how.collapsed + how.flipped > 0
    assert least_area_share(resolved) > 1e-12
    mesh = bare(resolved.vertices, resolved.faces)
    assert mesh.euler_number == 2
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
