"""Areas of faces against Heron's formula, and what is shared among corners face by face."""

from __future__ import annotations

import numpy as np
import pytest

from gipkg.descriptors.laplacian import heron_areas
from gipkg.surfaces.areas import at_vertices, face_areas
from tests.surfaces.solids import torus


def test_areas_are_those_of_the_edge_lengths():
    mesh = torus()
    corners = mesh.vertices[mesh.faces]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    areas = face_areas(mesh.vertices, mesh.faces)
    assert areas == pytest.approx(heron_areas(lengths))
    assert areas == pytest.approx(mesh.area_faces)


def test_every_corner_gets_a_third():
    faces = np.array([[0, 1, 2], [2, 1, 4]])
    shared = at_vertices(np.array([3.0, 30.0]), faces, 6)
    assert shared.tolist() == [1, 11, 11, 0, 10, 0]


def test_nothing_is_lost_on_the_way_to_the_vertices():
    mesh = torus()
    quantity = np.random.default_rng(0).standard_normal(len(mesh.faces))
    shared = at_vertices(quantity, mesh.faces, len(mesh.vertices))
    assert shared.sum() == pytest.approx(quantity.sum())
    around = [quantity[faces[faces >= 0]].sum() / 3 for faces in mesh.vertex_faces]
    assert shared == pytest.approx(np.array(around))
