"""The steps before anything is closed: cleaning, splitting, parts and orientation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from trimesh.transformations import rotation_matrix

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import cleaning, parts, splitting
from gipkg.surfaces.report import count
from gipkg.surfaces.triangles import Triangles
from tests.surfaces.solids import (
    assert_manifold_vertices,
    moebius_strip,
    soup,
    sphere,
    torus,
)


def triangles(mesh) -> Triangles:
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    return Triangles(vertices, faces, np.ones(len(vertices), bool))


def stacked(*meshes) -> Triangles:
    shift = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + k for mesh, k in zip(meshes, shift, strict=False)]
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    return Triangles(vertices, np.concatenate(faces), np.ones(len(vertices), bool))


def test_soup_is_sewn_together():
    ball = sphere()
    merged, number = cleaning.merge_border_vertices(triangles(soup(ball)), 1e-9)
    merged, unused = cleaning.remove_unused_vertices(merged)
    assert number == unused == 3 * len(ball.faces) - len(ball.vertices)
    after = count(merged.vertices, merged.faces)
    assert (after.vertices, after.holes, after.genus) == (len(ball.vertices), 0, 0)


@pytest.mark.parametrize(("tolerance", "closes"), [(1e-9, False), (1e-4, True)])
def test_merging_keeps_to_its_tolerance(tolerance, closes):
    shaken = triangles(soup(sphere()))
    noise = np.random.default_rng(0).uniform(-1e-6, 1e-6, shaken.vertices.shape)
    shaken = Triangles(shaken.vertices + noise, shaken.faces, shaken.original)
    merged, _ = cleaning.merge_border_vertices(shaken, tolerance)
    assert (count(merged.vertices, merged.faces).holes == 0) == closes


def test_merging_leaves_closed_surfaces_that_touch_apart():
    ball = triangles(sphere())
    two = stacked(sphere(), sphere())
    assert cleaning.merge_border_vertices(ball, 1e-3) == (ball, 0)
    assert cleaning.merge_border_vertices(two, 1e-3) == (two, 0)


def test_duplicates_go_and_folded_faces_stay():
    ball = triangles(sphere())
    again = np.roll(ball.faces[:4], 1, axis=1)
    folded = ball.faces[4:6, ::-1]
    doubled = ball.with_faces(np.concatenate((ball.faces, again, folded)))
    cleaned, removed = cleaning.remove_duplicate_faces(doubled)
    assert removed == 4
    assert np.array_equal(cleaned.faces, np.concatenate((ball.faces, folded)))


def test_collapsed_faces_go():
    ball = triangles(sphere())
    damaged = ball.with_faces(np.concatenate((ball.faces, [[0, 0, 1], [2, 3, 2]])))
    cleaned, removed = cleaning.remove_collapsed_faces(damaged)
    assert removed == 2
    assert np.array_equal(cleaned.faces, ball.faces)


def test_manifold_surface_is_not_split():
    for mesh in (sphere(), torus(), moebius_strip()):
        before = triangles(mesh)
        after, added = splitting.split_nonmanifold(before)
        assert added == 0
        assert np.array_equal(after.faces, before.faces)
        assert np.array_equal(after.vertices, before.vertices)


def test_spheres_that_share_a_vertex_come_apart():
    pair = stacked(sphere(), sphere())
    pair.faces[pair.faces == len(sphere().vertices)] = 0
    split, added = splitting.split_nonmanifold(pair.compact())
    assert added == 1
    assert_manifold_vertices(split.faces)
    assert count(split.vertices, split.faces).components == 2


def test_spheres_that_share_an_edge_come_apart_along_their_own_sheets():
    ball, other = sphere(), sphere()
    a, b = ball.faces[0, :2]
    axis = ball.vertices[b] - ball.vertices[a]
    other.apply_transform(rotation_matrix(np.pi, axis, ball.vertices[a]))
    pair = stacked(ball, other)
    shift = len(ball.vertices)
    faces = pair.faces.copy()
    faces[faces == shift + a] = a
    faces[faces == shift + b] = b
    split, added = splitting.split_nonmanifold(pair.with_faces(faces).compact())
    assert added == 2
    assert_manifold_vertices(split.faces)
    after = count(split.vertices, split.faces)
    assert (after.components, after.holes, after.genus) == (2, 0, 0)


def test_fin_comes_off():
    ball = triangles(sphere())
    a, b, _ = ball.faces[0]
    tip = 2 * (ball.vertices[a] + ball.vertices[b])
    finned = ball.append(tip[None], np.array([[a, b, len(ball.vertices)]]))
    split, added = splitting.split_nonmanifold(finned)
    body, dropped, _ = parts.largest_part(split)
    assert (added, dropped) == (2, 1)
    assert np.array_equal(body.faces, ball.faces)


def test_edge_that_two_sheets_share_at_both_ends_is_doubled_by_a_midpoint():
    """A tube of three sides pinched to one edge: its two sheets keep the edge's ends."""
    ball = triangles(sphere())
    a, b, _ = (int(v) for v in ball.faces[0])
    middle = (ball.vertices[a] + ball.vertices[b]) / 2
    n = len(ball.vertices)
    flap = np.array([[a, b, n], [b, a, n + 1], [a, n, n + 1], [n, b, n + 1]])
    bump = ball.append(np.array([1.2, 1.3])[:, None] * middle, flap)
    split, _ = splitting.split_nonmanifold(bump)
    assert_manifold_vertices(split.faces)
    edges = count(split.vertices, split.faces)
    assert edges.holes == 0
    assert edges.genus == 0


def test_largest_part_is_the_one_of_most_area():
    small = sphere(3)
    small.apply_scale(0.2)
    both = stacked(small, sphere(1))
    kept, dropped, share = parts.largest_part(both)
    assert dropped == 1
    assert np.array_equal(kept.faces, sphere(1).faces)
    assert share == pytest.approx(sphere(1).area / (sphere(1).area + small.area))


@settings(max_examples=25)
@given(st.sets(st.integers(0, 319), max_size=150))
def test_turned_faces_turn_back(turned):
    ball = triangles(sphere())
    faces = ball.faces.copy()
    faces[sorted(turned)] = faces[sorted(turned), ::-1]
    oriented, changed = parts.orient_consistently(ball.with_faces(faces))
    outward, _ = parts.orient_outward(oriented)
    assert (changed > 0) == bool(turned)
    assert parts.enclosed_volume(outward) == pytest.approx(sphere().volume)
    assert count(outward.vertices, outward.faces).genus == 0


def test_moebius_strip_has_one_side():
    with pytest.raises(UnsupportedMesh, match="one side only"):
        parts.orient_consistently(triangles(moebius_strip()))


def test_volume_is_that_of_the_solid_wherever_it_lies():
    far = triangles(torus(120, 60))
    far = Triangles(far.vertices + 1e4, far.faces, far.original)
    expected = 2 * np.pi**2 * 0.3**2
    assert parts.enclosed_volume(far) == pytest.approx(expected, rel=5e-3)
