from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from gipkg.baselines.corners import about_area_centroid, in_unit_ball
from gipkg.testing import meshes


def test_the_origin_is_the_centroid_of_the_surface_however_far_it_was() -> None:
    mesh = meshes.limbed()
    corners, areas = about_area_centroid(mesh)
    assert_allclose(areas, mesh.area_faces)
    assert_allclose(corners, mesh.triangles - mesh.centroid, atol=1e-12)
    far = meshes.mesh_of(mesh.vertices + 2.0**30, mesh.faces)
    assert_allclose(about_area_centroid(far)[0], corners, atol=1e-6)


def test_the_farthest_corner_is_on_the_unit_sphere() -> None:
    box = trimesh.creation.box(extents=(2, 4, 4))
    corners = in_unit_ball(box.triangles)
    assert np.linalg.norm(corners, axis=2).max() == pytest.approx(1)
    assert_allclose(corners, box.triangles / 3)
