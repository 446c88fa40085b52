"""Rendering: linear in the channels, equal on the cut, rotating with the sphere."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.images.cuts import random_cuts, standard_cuts
from gipkg.images.lookup import geometry_image, lookup
from gipkg.images.octahedron import pixel_directions
from gipkg.images.padding import pad

SEEDS = st.integers(0, 10**6)


@pytest.mark.parametrize("sampling", ["equal-area", "authors"])
def test_positions_of_a_sphere_lie_at_the_pixels_directions(sphere_map, sampling: str) -> None:
    image = geometry_image(sphere_map, sphere_map.sphere, 56, sampling=sampling)
    radius = np.linalg.norm(image, axis=0)
    longest = sphere_map.mesh.edges_unique_length.max()
    sagitta = 1 - np.sqrt(1 - longest**2 / 3)  # of an equilateral triangle's circumcircle
    assert (radius <= 1 + 1e-15).all()
    assert (radius >= 1 - sagitta).all()
    directions = np.moveaxis(pixel_directions(56, sampling), -1, 0)
    assert_allclose(image / radius, directions, atol=1e-14)


@settings(max_examples=10)
@given(seed=SEEDS)
def test_pixels_on_the_cut_agree_to_the_last_bit(star_map, seed: int) -> None:
    rng = np.random.default_rng([seed, 1])
    spherical_map = star_map(seed, 120)
    size = int(rng.integers(3, 40))
    pixels = lookup(spherical_map, size, random_cuts(4, rng))
    images = pixels.render(rng.standard_normal((120, 2)))
    assert images.shape == (4, 2, size, size)
    assert images.dtype == np.float32
    for side in (images[..., 0, :], images[..., -1, :], images[..., 0], images[..., -1]):
        assert_array_equal(side, side[..., ::-1])
    assert_array_equal(images[..., 0, 0], images[..., -1, -1])
    assert_array_equal(images[..., 0, 0], images[..., 0, -1])


@settings(max_examples=10)
@given(seed=SEEDS)
def test_a_cut_is_a_rotation_of_the_sphere(star_map, seed: int) -> None:
    rng = np.random.default_rng([seed, 2])
    spherical_map, cut = star_map(seed, 80), random_cuts(1, rng)[0]
    channels = rng.standard_normal((80, 3))
    turned = SphericalMap(spherical_map.mesh, cut.apply(spherical_map.sphere))
    # Round-off moves a direction by an ulp; the cluster's faces are 1e-3 wide or less.
    assert_allclose(
        geometry_image(turned, channels, 24),
        geometry_image(spherical_map, channels, 24, cut),
        atol=1e-7,
    )


def test_the_nearest_vertex_is_the_one_that_counts_most(star_map) -> None:
    spherical_map = star_map(7, 60)
    pixels = lookup(spherical_map, 20, standard_cuts()[:3])
    one_hot = pixels.render(np.eye(60), np.float64)
    assert_array_equal(pixels.nearest, one_hot.argmax(axis=1))


def test_all_cuts_at_once_equal_one_by_one(star_map) -> None:
    spherical_map, cuts = star_map(5, 100), standard_cuts()
    channels = np.random.default_rng(5).standard_normal((100, 2))
    together = lookup(spherical_map, 20, cuts).render(channels, np.float64)
    for cut, image in zip(cuts, together, strict=True):
        assert_allclose(geometry_image(spherical_map, channels, 20, cut), image, atol=1e-12)


def test_a_half_turn_about_the_pole_turns_the_image(star_map) -> None:
    spherical_map, cuts = star_map(6, 100), standard_cuts()
    images = lookup(spherical_map, 21, cuts).render(np.asarray(spherical_map.mesh.vertices))
    for axis in range(0, 36, 6):
        for turn in range(3):
            assert_allclose(images[axis + turn + 3], images[axis + turn, :, ::-1, ::-1], atol=1e-5)


@settings(max_examples=10)
@given(seed=SEEDS)
def test_numbering_does_not_matter(star_map, seed: int) -> None:
    rng = np.random.default_rng([seed, 3])
    spherical_map = star_map(seed, 60)
    mesh, channels = spherical_map.mesh.copy(), rng.standard_normal((60, 2))
    order = rng.permutation(60)
    rank = np.argsort(order)
    mesh.vertices, mesh.faces = mesh.vertices[order], rank[mesh.faces][rng.permutation(116)]
    renumbered = SphericalMap(mesh, spherical_map.sphere[order])
    assert_allclose(
        geometry_image(renumbered, channels[order], 20),
        geometry_image(spherical_map, channels, 20),
        atol=1e-9,
    )


def test_a_constant_stays_constant_and_extremes_are_kept(star_map) -> None:
    spherical_map = star_map(7, 150)
    channels = np.random.default_rng(7).uniform(size=(150, 2))
    channels[:, 0] = 1
    images = lookup(spherical_map, 30, standard_cuts()).render(channels, np.float64)
    assert_allclose(images[:, 0], 1, atol=1e-15)
    assert images[:, 1].min() >= channels[:, 1].min()
    assert images[:, 1].max() <= channels[:, 1].max()


def test_the_neighbour_over_the_cut_is_the_neighbour_on_the_sphere(sphere_map) -> None:
    """Padding one pixel continues the positions as smoothly as the image itself goes on."""
    images = lookup(sphere_map, 56, standard_cuts()).render(sphere_map.sphere, np.float64)
    padded = pad(images, 4)
    step = np.linalg.norm(np.diff(padded, axis=-1), axis=1)
    inside = np.linalg.norm(np.diff(images, axis=-1), axis=1).max()
    assert step.max() <= inside * (1 + 1e-12)
    assert step[:, 4:-4, [3, -4]].min() > 0


def test_channels_of_another_mesh_are_refused(sphere_map) -> None:
    with pytest.raises(ValueError, match=r"\(3, 2\), they must be \(2562, C\)"):
        geometry_image(sphere_map, np.zeros((3, 2)))


def test_a_map_that_does_not_cover_the_sphere_is_refused(sphere_map) -> None:
    squashed = sphere_map.sphere * [1, 1, 0.5] + [0, 0, 0.9]
    squashed /= np.linalg.norm(squashed, axis=1, keepdims=True)
    with pytest.raises(UnsupportedMesh, match="covers the direction"):
        geometry_image(SphericalMap(sphere_map.mesh, squashed), sphere_map.sphere, 8)


def test_an_open_mesh_is_refused(sphere_map) -> None:
    mesh = sphere_map.mesh.copy()
    mesh.update_faces(np.arange(len(mesh.faces)) > 0)
    with pytest.raises(UnsupportedMesh, match="it is open"):
        lookup(SphericalMap(mesh, sphere_map.sphere), 8, Rotation.identity())
