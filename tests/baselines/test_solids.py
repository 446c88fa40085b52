from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from gipkg.baselines.solids import about_volume_centroid, principal_frame, require_solid
from gipkg.errors import UnsupportedMesh
from gipkg.testing import meshes


def test_the_origin_is_the_centroid_of_the_solid_however_far_it_was() -> None:
    mesh = meshes.limbed()
    corners = about_volume_centroid(mesh)
    assert_allclose(corners, mesh.triangles - mesh.center_mass, atol=1e-12)
    far = meshes.mesh_of(mesh.vertices + 2.0**30, mesh.faces)
    assert_allclose(about_volume_centroid(far), corners, atol=1e-6)


@pytest.mark.parametrize("asked", [require_solid, about_volume_centroid, principal_frame])
@pytest.mark.parametrize("fault", ["inside out", "flat"])
def test_a_mesh_that_encloses_no_volume_is_refused(asked, fault: str) -> None:
    mesh = meshes.limbed()
    if fault == "flat":
        mesh.vertices = mesh.vertices * [1, 1, 0]
    else:
        mesh.invert()
    with pytest.raises(UnsupportedMesh, match="outwards"):
        asked(mesh)


def test_the_longest_axis_stands_upright_with_its_tail_above() -> None:
    cone = trimesh.creation.cone(radius=1.0, height=8.0)
    turn = trimesh.transformations.random_rotation_matrix(np.array([0.1, 0.7, 0.4]))
    turn[:3, 3] = 1e3
    cone.apply_transform(turn)
    frame = principal_frame(cone)
    assert_allclose(frame.T @ frame, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1)
    assert_allclose(frame[:, 2], turn[:3, 2], atol=1e-6)  # From the base to the tip.


def test_a_moved_mesh_stands_as_before_but_for_half_a_turn() -> None:
    mesh = meshes.limbed()
    moved = meshes.moved(mesh, np.random.default_rng(0))
    upright, again = (np.asarray(one.vertices) @ principal_frame(one) for one in (mesh, moved))
    upright, again = upright - upright.mean(axis=0), again - again.mean(axis=0)
    assert_allclose(np.abs(again), np.abs(upright), atol=1e-9)
    assert_allclose(again[:, 2], upright[:, 2], atol=1e-9)
