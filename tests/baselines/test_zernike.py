from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from scipy.special import eval_jacobi, roots_legendre, sph_harm_y

from gipkg.baselines.zernike import Zernike
from gipkg.baselines.zernike_moments import zernike_moments
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh

ORDER = 20


def represent(mesh: trimesh.Trimesh) -> np.ndarray:
    return Zernike(order=ORDER).represent(mesh, Operators(mesh))


def bent_shape() -> trimesh.Trimesh:
    """A closed solid without any symmetry."""
    mesh = trimesh.creation.icosphere(subdivisions=2)
    x, y, z = mesh.vertices.T
    mesh.vertices = np.stack([x * (1.5 + 0.4 * y), y + 0.3 * x * x, z * (0.6 + 0.2 * x)], axis=1)
    return mesh


@pytest.mark.parametrize("cells", [1, 6])
def test_moments_of_a_box_equal_a_quadrature_of_the_functions_themselves(cells: int) -> None:
    # Coarse faces use the exact rule, fine ones a smaller one; the solid is the same.
    box = trimesh.creation.box(bounds=[[-0.5, -0.2, -0.4], [0.6, 0.3, 0.1]])
    if cells > 1:
        box = box.subdivide_to_size(1 / cells)
    moments = zernike_moments(np.asarray(box.triangles), ORDER)

    nodes, weights = roots_legendre(ORDER // 2 + 1)  # exact for this degree
    low, high = box.bounds
    half = (high - low) / 2
    points = np.stack(np.meshgrid(*(half[:, None] * nodes + (low + half)[:, None])), -1)
    points = points.reshape(-1, 3)
    volume = np.prod(half) * np.stack(np.meshgrid(weights, weights, weights)).prod(0).ravel()
    r = np.linalg.norm(points, axis=1)
    theta, phi = np.arccos(points[:, 2] / r), np.arctan2(points[:, 1], points[:, 0])
    assert len(moments) == 121
    for (n, degree), found in moments.items():
        radial = r**degree * eval_jacobi((n - degree) // 2, 0, degree + 0.5, 2 * r**2 - 1)
        norm = np.sqrt(2 * n + 3) * np.sqrt(3 / (4 * np.pi))
        expected = [
            norm * volume @ (radial * sph_harm_y(degree, m, theta, phi).conj())
            for m in range(-degree, degree + 1)
        ]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


def test_a_ball_has_one_moment() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4)
    found = represent(ball)
    # The polyhedron lacks a little of the ball, mostly near the surface.
    assert found[0] == pytest.approx(ball.volume / (4 / 3 * np.pi), rel=1e-3)
    assert np.abs(found[1:]).max() < 1e-2


def test_a_motion_a_size_and_an_order_of_vertices_change_nothing() -> None:
    mesh = bent_shape()
    expected = represent(mesh)
    assert np.count_nonzero(expected > 1e-4) > 100
    rng = np.random.default_rng(3)
    moved = mesh.copy()
    moved.vertices = 37 * Rotation.random(rng=3).apply(moved.vertices) + [1000, -500, 200]
    np.testing.assert_allclose(represent(moved), expected, rtol=0, atol=1e-9)
    order = rng.permutation(len(mesh.vertices))
    shuffled = trimesh.Trimesh(
        mesh.vertices[order], np.argsort(order)[mesh.faces][::-1], process=False
    )
    np.testing.assert_allclose(represent(shuffled), expected, rtol=0, atol=1e-9)


def test_different_solids_differ() -> None:
    mesh = bent_shape()
    other = mesh.copy()
    other.vertices[:, 2] *= 1.1
    assert np.linalg.norm(represent(mesh) - represent(other)) > 1e-2


def test_a_mesh_turned_inside_out_is_refused() -> None:
    mesh = bent_shape()
    mesh.invert()
    with pytest.raises(UnsupportedMesh, match="oriented outwards"):
        represent(mesh)
