from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from gipkg.baselines.voxels import crossed, turned_solids, voxelise
from gipkg.errors import UnsupportedMesh
from gipkg.testing import meshes

SIZE = 16


def solid(mesh: trimesh.Trimesh, size: int = SIZE) -> np.ndarray:
    """Voxelise a mesh whose unit is the voxel."""
    return voxelise(np.asarray(mesh.vertices)[mesh.faces], size)


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_voxels_are_where_a_convex_body_is(seed: int) -> None:
    """Second route: a point is inside a convex body if it is behind all its faces."""
    rng = np.random.default_rng(seed)
    body = trimesh.convex.convex_hull(rng.uniform(-2, SIZE + 1, (12, 3)))
    points = np.indices((SIZE, SIZE, SIZE)).reshape(3, -1).T
    heights = points @ body.face_normals.T
    inside = heights < np.einsum("fi,fi->f", body.triangles[:, 0], body.face_normals)
    assert_array_equal(solid(body).ravel(), inside.all(axis=1))


@pytest.mark.parametrize("corner", [0.0, 2.0, 2.5])
def test_a_box_through_voxel_centres_keeps_one_of_two_opposite_sides(corner: float) -> None:
    """No column leaks where edges and diagonals pass through centres, even at the border."""
    box = trimesh.creation.box(extents=(8, 8, 8))
    box.apply_translation(np.full(3, corner + 4))
    found = solid(box)
    assert found.sum() == 8**3
    assert_array_equal(np.ptp(np.argwhere(found), axis=0), 7)


def test_a_ball_has_its_volume() -> None:
    ball = trimesh.creation.icosphere(4)
    corners = ball.triangles * 20 + 23.5
    assert voxelise(corners, 48).sum() == pytest.approx(4 / 3 * np.pi * 20**3, rel=0.01)


def test_a_solid_holds_what_its_surface_passes_through() -> None:
    """A ball's crossed voxels have centres within half a diagonal of it, and cover all between."""
    ball = trimesh.creation.icosphere(4)
    grid = turned_solids(ball, 2, 48, 40)[0]
    heights = np.linalg.norm(np.indices(grid.shape) - 23.5, axis=0) - 39 / 2
    assert grid[heights < 0.25].all()
    assert not grid[heights > np.sqrt(3) / 2].any()


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_voxels_with_a_piece_of_the_surface_are_crossed(seed: int) -> None:
    """Second route: points drawn at random on triangles, away from the edges of voxels."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0, SIZE - 1, (5, 3, 3))
    marked = crossed(corners, SIZE)
    points = np.einsum("pk,fkc->fpc", rng.dirichlet(np.ones(3), 400), corners).reshape(-1, 3)
    voxels = np.rint(points).astype(int)
    clear = np.abs(points - voxels).max(axis=1) < 0.25
    assert marked[tuple(voxels[clear].T)].all()
    centres, normals = (
        np.argwhere(marked),
        np.cross(*(corners[:, 1:] - corners[:, :1]).swapaxes(0, 1)),
    )
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    distances = np.abs(np.einsum("fvc,fc->fv", centres - corners[:, :1], normals)).min(axis=0)
    assert distances.max() <= np.sqrt(3) / 2


def test_a_sheet_is_not_empty() -> None:
    sheet = trimesh.creation.box(extents=(1, 0.7, 1e-4))
    solid = turned_solids(sheet, 4, SIZE, 12)[0]
    assert solid.any(axis=2).sum() == pytest.approx(12 * 0.7 * 12, rel=0.1)
    assert solid.any(axis=(0, 1)).sum() <= 2


def test_what_is_outside_the_grid_is_cut_off() -> None:
    box = trimesh.creation.box(extents=(100, 100, 100))
    assert solid(box).all()
    box.apply_translation((0, 0, -50 + 3.5))
    assert_array_equal(solid(box)[2, 5], np.arange(SIZE) <= 3)


def test_a_body_enclosed_twice_is_solid_and_a_cavity_is_empty() -> None:
    outer = trimesh.creation.box(extents=(12, 12, 12))
    inner = trimesh.creation.box(extents=(4, 4, 4))
    for body in (outer, inner):
        body.apply_translation((7.5, 7.5, 7.5))
    assert solid(trimesh.util.concatenate([outer, inner])).sum() == 12**3
    inner.invert()
    assert solid(trimesh.util.concatenate([outer, inner])).sum() == 12**3 - 4**3


def test_rotations_are_centred_of_one_scale_and_fit() -> None:
    mesh = meshes.mesh_of(meshes.limbed().vertices * 1e3 + 1e5, meshes.limbed().faces)
    grids = turned_solids(mesh, 4, 32, 24)
    for k in range(4):
        assert_array_equal(grids[k], np.rot90(grids[0], k))
    filled = [np.argwhere(grid) for grid in turned_solids(mesh, 12, 32, 24)]
    assert min(voxels.min() for voxels in filled) >= 4
    assert max(voxels.max() for voxels in filled) <= 27
    assert max(np.ptp(voxels, axis=0).max() for voxels in filled) == 23


def test_a_mesh_that_is_inside_out_is_refused() -> None:
    mesh = meshes.limbed()
    mesh.invert()
    with pytest.raises(UnsupportedMesh, match="outwards"):
        turned_solids(mesh, 2, SIZE, 12)
