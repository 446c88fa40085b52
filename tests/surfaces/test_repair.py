"""Every defect is repaired by the steps that it takes, or named where it cannot be."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import prepare
from tests.surfaces.prepared import assert_sound, step_names
from tests.surfaces.solids import (
    bare,
    chain_of_tori,
    moebius_strip,
    soup,
    sphere,
    torus,
    without_cap,
)


def test_surface_turned_inside_out_is_turned_back():
    ball = sphere()
    surface = prepare(bare(ball.vertices, ball.faces[:, ::-1]))
    assert step_names(surface) == ["turn outward"]
    assert surface.report.steps[0].figures == {"faces": len(ball.faces)}
    assert np.array_equal(surface.mesh.faces, ball.faces)
    assert_sound(surface)


@pytest.mark.parametrize("genus", [1, 3])
def test_handles_are_cut_and_masked(genus):
    mesh = chain_of_tori(genus)
    surface = prepare(mesh)
    assert step_names(surface) == ["cut handles"]
    assert surface.report.before.genus == genus
    assert surface.report.steps[0].figures["handles"] == genus
    assert (~surface.mask).sum() >= 2 * genus
    kept = np.linalg.norm(surface.mesh.vertices[: len(mesh.vertices)] - mesh.vertices, axis=1)
    assert np.median(kept) == 0
    assert kept.max() < 0.01
    assert_sound(surface)


def test_everything_at_once():
    """A soup of a holed genus-1 surface with turned and doubled faces, and a crumb beside it."""
    ring = torus(40, 20)
    faces = np.delete(ring.faces, [5, 100, 300], axis=0)
    faces[::7] = faces[::7, ::-1]
    body = soup(bare(ring.vertices, np.concatenate((faces, faces[:9]))))
    crumb = sphere(0)
    crumb.apply_scale(0.02)
    crumb.apply_translation((5, 0, 0))
    surface = prepare(trimesh.util.concatenate([body, crumb]))
    assert step_names(surface) == [
        "merge border vertices",
        "remove duplicate faces",
        "remove unused vertices",
        "keep largest part",
        "orient faces",
        "fill holes",
        "cut handles",
    ]
    assert surface.mesh.volume == pytest.approx(ring.volume, rel=0.02)
    assert_sound(surface)


def test_parts_left_out_are_told():
    crumb = sphere(1)
    crumb.apply_scale(0.1)
    surface = prepare(trimesh.util.concatenate([crumb, sphere(1)]))
    assert surface.report.steps[0].figures == {
        "dropped parts": 1,
        "area share": pytest.approx(1 / 1.01),
    }
    assert np.array_equal(surface.mesh.vertices, sphere(1).vertices)
    assert_sound(surface)


def test_losing_most_of_the_shape_needs_consent():
    balls = [sphere(1) for _ in range(3)]
    for k, ball in enumerate(balls):
        ball.apply_translation((3 * k, 0, 0))
    three = trimesh.util.concatenate(balls)
    with pytest.raises(UnsupportedMesh, match=r"3 parts has only 33%.*smallest_part=0"):
        prepare(three, method="repair")
    assert_sound(prepare(three, method="repair", smallest_part=0))


def test_box_with_a_square_hole_through_it():
    outer, inner = trimesh.creation.box((3, 3, 1)), trimesh.creation.box((1, 1, 1))
    wall = np.abs(outer.face_normals[:, 2]) < 0.5
    tunnel = np.abs(inner.face_normals[:, 2]) < 0.5
    rings = []
    for z, turn in ((0.5, 1), (-0.5, -1)):
        square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        outside = np.column_stack((1.5 * square, np.full(4, z)))
        inside = np.column_stack((0.5 * square, np.full(4, z)))
        faces = np.array(
            [t for k in range(4) for j in [(k + 1) % 4] for t in ((k, j, j + 4), (k, j + 4, k + 4))]
        )
        rings.append(bare(np.concatenate((outside, inside)), faces[:, ::turn]))
    parts = [
        bare(outer.vertices, outer.faces[wall]),
        bare(inner.vertices, inner.faces[tunnel][:, ::-1]),
        *rings,
    ]
    surface = prepare(soup(trimesh.util.concatenate(parts)))
    assert "cut handles" in step_names(surface)
    assert surface.mesh.volume == pytest.approx(8, rel=0.25)
    assert_sound(surface)


def test_opened_sphere_is_capped():
    surface = prepare(without_cap(sphere(3), 0.6))
    assert step_names(surface) == ["remove unused vertices", "fill holes"]
    assert surface.report.before.holes == 1
    assert_sound(surface)


def test_edge_closed_by_a_sliver():
    """A vertex that lies in its neighbour's edge, the crack between them open."""
    ball = sphere()
    a, b, c = ball.faces[0]
    middle = (ball.vertices[a] + ball.vertices[b]) / 2
    n = len(ball.vertices)
    faces = np.concatenate((ball.faces[1:], [[a, n, c], [n, b, c]]))
    surface = prepare(bare(np.concatenate((ball.vertices, [middle])), faces))
    assert "fill holes" in step_names(surface)
    assert surface.mesh.volume == pytest.approx(ball.volume, rel=1e-3)
    assert_sound(surface)


@pytest.mark.parametrize(
    ("mesh", "fault"),
    [
        (moebius_strip(), "one side only"),
        (bare(np.eye(3), [[0, 1, 2]]), "open sheet"),
        (without_cap(sphere(3), -0.5), "largest_hole=1"),
        (bare(np.zeros((0, 3)), np.zeros((0, 3), int)), "no faces"),
        (bare(np.full((3, 3), np.nan), [[0, 1, 2]]), "not finite"),
        (bare(np.eye(3), [[0, 1, 7]]), "does not exist"),
    ],
    ids=["Möbius strip", "triangle", "shallow bowl", "empty", "nan", "index"],
)
def test_what_cannot_be_repaired_says_why(mesh, fault):
    with pytest.raises(UnsupportedMesh, match=fault):
        prepare(mesh, method="repair")


@pytest.mark.parametrize(
    "mesh",
    [bare(np.eye(3), [[0, 0, 1], [2, 1, 2]]), bare(np.ones((12, 3)), sphere(0).faces)],
    ids=["collapsed faces", "a single place"],
)
def test_no_area_at_all(mesh):
    with pytest.raises(UnsupportedMesh, match="no area"):
        prepare(mesh)


def test_largest_hole_may_be_allowed():
    surface = prepare(without_cap(sphere(3), -0.5), largest_hole=1)
    assert_sound(surface)


def test_flat_sheet_bounds_no_solid():
    with pytest.raises(UnsupportedMesh, match="encloses no volume"):
        prepare(bare(np.eye(3), [[0, 1, 2]]), method="repair", largest_hole=1)


def turn_faces(mesh, random):
    faces = mesh.faces.copy()
    some = random.choice(len(faces), 20, replace=False)
    faces[some] = faces[some, ::-1]
    return bare(mesh.vertices, faces)


def drop_faces(mesh, random):
    return bare(mesh.vertices, np.delete(mesh.faces, random.choice(len(mesh.faces), 15), axis=0))


def double_faces(mesh, random):
    return bare(mesh.vertices, np.concatenate((mesh.faces, mesh.faces[:10])))


def double_vertices(mesh, random):
    faces = mesh.faces.copy()
    some = random.choice(len(faces), 30, replace=False)
    faces[some, 0] = len(mesh.vertices) + np.arange(30)
    return bare(np.concatenate((mesh.vertices, mesh.vertices[mesh.faces[some, 0]])), faces)


def add_unused_vertices(mesh, random):
    return bare(np.concatenate((mesh.vertices, random.standard_normal((5, 3)))), mesh.faces)


def add_fins(mesh, random):
    some = random.choice(len(mesh.faces), 5, replace=False)
    tips = 2 * mesh.vertices[mesh.faces[some, 2]]
    fins = np.column_stack((mesh.faces[some, :2], len(mesh.vertices) + np.arange(5)))
    return bare(np.concatenate((mesh.vertices, tips)), np.concatenate((mesh.faces, fins)))


def pinch_vertices(mesh, random):
    """Two vertices far from each other become one."""
    faces = mesh.faces.copy()
    far = int(np.argmax(np.linalg.norm(mesh.vertices - mesh.vertices[0], axis=1)))
    faces[faces == far] = 0
    return bare(mesh.vertices, faces)


def collapse_faces(mesh, random):
    vertices = mesh.vertices.copy()
    for face in mesh.faces[random.choice(len(mesh.faces), 4, replace=False)]:
        vertices[face[2]] = vertices[face[:2]].mean(axis=0)
    return bare(vertices, mesh.faces)


def add_crumb(mesh, random):
    crumb = sphere(0)
    crumb.apply_scale(0.01)
    return trimesh.util.concatenate([crumb, mesh])


DEFECTS = [
    turn_faces,
    drop_faces,
    double_faces,
    double_vertices,
    add_unused_vertices,
    add_fins,
    pinch_vertices,
    collapse_faces,
    add_crumb,
    lambda mesh, random: soup(mesh),
]


@settings(max_examples=60)
@given(
    st.sampled_from([sphere(2), torus(20, 10), chain_of_tori(2)]),
    st.lists(st.sampled_from(DEFECTS), min_size=1, max_size=2, unique=True),
    st.integers(0, 10**6),
)
def test_defects_are_repaired(mesh, defects, seed):
    random = np.random.default_rng(seed)
    damaged = mesh
    for defect in defects:
        damaged = defect(damaged, random)
    surface = prepare(damaged, method="repair")
    assert_sound(surface)
    assert surface.mesh.volume == pytest.approx(mesh.volume, rel=0.25)
