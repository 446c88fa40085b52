"""Image of positions to a closed mesh, and how fast it nears the surface."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.api import SphericalMap
from gipkg.images.cuts import random_cuts
from gipkg.images.lookup import geometry_image
from gipkg.images.octahedron import pixel_directions
from gipkg.images.reconstruct import reconstruct
from gipkg.surfaces.validation import check_genus_zero


@settings(max_examples=10)
@given(seed=st.integers(0, 10**6))
def test_the_result_is_a_closed_genus_zero_surface(star_map, seed: int) -> None:
    rng = np.random.default_rng([seed, 4])
    spherical_map = star_map(seed, 100)
    size = int(rng.integers(4, 40))
    image = geometry_image(
        spherical_map, np.asarray(spherical_map.mesh.vertices), size, random_cuts(1, rng)[0]
    )
    mesh = reconstruct(image)
    assert len(mesh.vertices) == (size - 2) ** 2 + 4 * ((size - 1) // 2) + 1
    assert len(mesh.faces) == 2 * len(mesh.vertices) - 4
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    pixels = np.moveaxis(image, 0, -1).reshape(-1, 3)
    assert_array_equal(np.unique(mesh.vertices, axis=0), np.unique(pixels, axis=0))


@pytest.mark.parametrize("size", [3, 4, 5, 6, 7, 12, 56, 57])
def test_a_sphere_comes_back_as_one_at_every_size(size: int) -> None:
    mesh = reconstruct(np.moveaxis(pixel_directions(size), -1, 0))
    check_genus_zero(mesh)
    assert mesh.volume > 0
    outward = np.einsum("ij,ij->i", mesh.face_normals, mesh.triangles_center)
    assert (outward > 0).all()


def test_three_pixels_a_side_are_the_octahedron() -> None:
    mesh = reconstruct(np.moveaxis(pixel_directions(3), -1, 0))
    assert mesh.volume == pytest.approx(4 / 3)
    assert mesh.area == pytest.approx(4 * np.sqrt(3))


def test_the_distance_to_an_ellipsoid_falls_with_the_square_of_the_size() -> None:
    """Both surfaces are star-shaped, so the greatest radial error bounds the Hausdorff one."""
    axes = np.array([1.0, 0.7, 0.4])
    barycentric = np.array([[i, j, 12 - i - j] for i in range(13) for j in range(13 - i)]) / 12
    errors = []
    for size in (15, 29, 57, 113):
        mesh = reconstruct(np.moveaxis(pixel_directions(size) * axes, -1, 0))
        samples = np.einsum("si,fij->fsj", barycentric, mesh.triangles).reshape(-1, 3)
        radii = np.linalg.norm(samples, axis=1)
        errors.append(np.abs(radii - radii / np.linalg.norm(samples / axes, axis=1)).max())
    ratios = np.array(errors[:-1]) / errors[1:]
    assert errors[-1] < 1e-3
    assert_allclose(ratios, 4, rtol=0.2)


def test_a_mesh_and_its_reconstruction_converge(sphere_map) -> None:
    mesh = sphere_map.mesh.copy()
    mesh.apply_scale([1.0, 0.8, 0.5])
    ellipsoid = type(sphere_map)(mesh, sphere_map.sphere)
    volumes = [reconstruct(geometry_image(ellipsoid, mesh.vertices, n)).volume for n in (15, 57)]
    assert np.abs(volumes[1] / mesh.volume - 1) < 2e-3
    assert np.abs(volumes[1] - mesh.volume) < np.abs(volumes[0] - mesh.volume) / 10


def test_pixels_that_disagree_on_the_cut_meet_at_their_mean() -> None:
    image = np.moveaxis(pixel_directions(8), -1, 0).copy()
    image[:, 0, 2] += [0.5, 0, 0]
    mesh = reconstruct(image)
    check_genus_zero(mesh)
    middle = (image[:, 0, 2] + image[:, 0, 5]) / 2
    assert np.linalg.norm(mesh.vertices - middle, axis=1).min() < 1e-15


@pytest.mark.parametrize("shape", [(8, 8), (2, 8, 8), (3, 8, 9)])
def test_other_shapes_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"must be \(3, n, n\)"):
        reconstruct(np.zeros(shape))


def test_two_pixels_a_side_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 3 x 3 pixels, not 2 x 2"):
        reconstruct(np.zeros((3, 2, 2)))


def test_the_orientation_is_that_of_the_mesh() -> None:
    mesh = trimesh.creation.icosphere(3)
    sphere = np.asarray(mesh.vertices) @ np.diag([1.0, 1.0, -1.0])
    mesh = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    mesh.invert()
    image = geometry_image(SphericalMap(mesh, sphere), np.asarray(mesh.vertices), 20)
    assert reconstruct(image).volume == pytest.approx(mesh.volume, rel=0.05)
