from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import check_genus_zero
from tests.surfaces.solids import bare, chain_of_tori, soup, sphere, torus


def fault_of(mesh: trimesh.Trimesh) -> str:
    with pytest.raises(UnsupportedMesh) as caught:
        check_genus_zero(mesh)
    assert "gipkg.prepare" in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("subdivisions", [0, 3])
def test_spheres_pass(subdivisions):
    check_genus_zero(sphere(subdivisions))
    check_genus_zero(trimesh.creation.box())


@pytest.mark.parametrize("genus", [1, 2, 3])
def test_genus_is_named(genus):
    assert f"its genus is {genus}, not 0" in fault_of(chain_of_tori(genus))


@given(st.permutations(range(42)), st.integers(0, 2))
def test_order_of_vertices_and_corners_does_not_matter(order, turn):
    ball = sphere(1)
    faces = np.roll(np.argsort(order)[ball.faces], turn, axis=1)
    check_genus_zero(bare(ball.vertices[list(order)], faces))


def test_open_surface():
    ball = sphere()
    assert "it is open: 3 edges" in fault_of(bare(ball.vertices, ball.faces[1:]))


def test_turned_face():
    ball = sphere()
    faces = ball.faces.copy()
    faces[7] = faces[7, ::-1]
    assert "two faces at 3 edges are oriented against each other" in fault_of(
        bare(ball.vertices, faces)
    )


def test_crowded_edge_and_several_faults_in_one_message():
    ball = sphere()
    vertices = np.concatenate((ball.vertices, [[0, 0, 2.0], [0, 0, 3.0]]))
    fin = [[*ball.faces[0, :2], len(ball.vertices)]]
    message = fault_of(bare(vertices, np.concatenate((ball.faces, fin))))
    assert "1 vertices belong to no face" in message
    assert "1 edges belong to more than two faces" in message
    assert "it is open: 2 edges" in message


def test_two_components():
    ball = sphere()
    assert "2 components" in fault_of(trimesh.util.concatenate([ball, torus()]))


def test_pinched_vertices():
    one, two = sphere(), sphere()
    two.apply_translation((2, 0, 0))
    both = trimesh.util.concatenate([one, two])
    faces = both.faces.copy()
    faces[faces == len(one.vertices)] = 0
    kept = np.unique(faces)
    mesh = bare(both.vertices[kept], np.searchsorted(kept, faces))
    assert "1 vertices pinch the surface" in fault_of(mesh)


def test_two_spheres_pinched_twice_have_characteristic_two_and_still_fail():
    one, two = sphere(), sphere()
    faces = two.faces + len(one.vertices)
    for vertex in (0, 3):
        faces[faces == len(one.vertices) + vertex] = vertex
    both = np.concatenate((one.faces, faces))
    kept = np.unique(both)
    mesh = bare(np.concatenate((one.vertices, two.vertices))[kept], np.searchsorted(kept, both))
    assert mesh.euler_number == 2
    assert mesh.body_count == 1
    assert "2 vertices pinch the surface" in fault_of(mesh)


def test_face_without_area():
    vertices = sphere().vertices.copy()
    a, b, c = sphere().faces[0]
    vertices[c] = (vertices[a] + vertices[b]) / 2
    assert "1 faces have no area" in fault_of(bare(vertices, sphere().faces))


def test_repeated_vertex():
    ball = sphere()
    faces = ball.faces.copy()
    faces[0, 1] = faces[0, 0]
    assert "1 faces name a vertex twice" in fault_of(bare(ball.vertices, faces))


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_vertices_not_finite(value):
    vertices = sphere().vertices.copy()
    vertices[4, 1] = value
    assert "1 vertices are not finite" in fault_of(bare(vertices, sphere().faces))


def test_index_out_of_range_and_no_faces():
    ball = sphere()
    faces = ball.faces.copy()
    faces[3, 0] = len(ball.vertices)
    assert "1 faces name a vertex that does not exist" in fault_of(bare(ball.vertices, faces))
    assert "no faces" in fault_of(bare(ball.vertices, np.zeros((0, 3), int)))


def test_soup_is_open_everywhere_and_the_mesh_is_not_changed():
    mesh = soup(sphere())
    before = mesh.vertices.copy(), mesh.faces.copy()
    assert f"{3 * len(mesh.faces)} edges belong to one face only" in fault_of(mesh)
    assert np.array_equal(mesh.vertices, before[0])
    assert np.array_equal(mesh.faces, before[1])
