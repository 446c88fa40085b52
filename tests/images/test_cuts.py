"""The paper's 36 cuts, those of upright shapes, and uniform random ones."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation
from trimesh.intersections import mesh_plane

from gipkg.api import SphericalMap
from gipkg.images.axis import highest_on_axis
from gipkg.images.cuts import random_cuts, standard_cuts, upright_cuts
from gipkg.images.lookup import geometry_image, lookup


def test_six_polar_axes_with_six_turns_of_sixty_degrees() -> None:
    cuts = standard_cuts()
    assert len(cuts) == 36
    assert_array_equal(cuts[0].as_matrix(), np.eye(3))
    poles = cuts.inv().apply([0, 0, 1]).reshape(6, 6, 3)
    assert_allclose(poles, np.repeat(poles[:, :1], 6, axis=1), atol=1e-15)
    assert {tuple(p) for p in np.rint(poles[:, 0]).astype(int).tolist()} == {
        (sign if k == 0 else 0, sign if k == 1 else 0, sign if k == 2 else 0)
        for k in range(3)
        for sign in (-1, 1)
    }
    turns = cuts.as_matrix().reshape(6, 6, 3, 3)
    steps = turns[:, 1:] @ np.swapaxes(turns[:, :-1], -1, -2)
    sixty = [[0.5, -np.sqrt(0.75), 0], [np.sqrt(0.75), 0.5, 0], [0, 0, 1]]
    assert_allclose(steps, np.broadcast_to(sixty, steps.shape), atol=1e-15)


def test_random_cuts_are_uniform_and_repeatable() -> None:
    cuts = random_cuts(20_000, np.random.default_rng(0))
    assert_array_equal(
        cuts[:5].as_quat(), random_cuts(20_000, np.random.default_rng(0))[:5].as_quat()
    )
    # Haar measure: the rotation angle has density (1 - cos a) / π, mean π/2 + 2/π.
    assert_allclose(cuts.magnitude().mean(), np.pi / 2 + 2 / np.pi, atol=0.02)
    assert_allclose(cuts.apply([0, 0, 1]).mean(axis=0), 0, atol=0.02)


def lopsided(star_map) -> SphericalMap:
    """Return a star-shaped surface under a map that is turned away from it."""
    straight = star_map(3, 200)
    turn = Rotation.from_rotvec([0.4, -0.9, 1.3])
    return SphericalMap(straight.mesh, turn.apply(straight.sphere))


def shown_at_the_centre(spherical_map: SphericalMap, cut: Rotation) -> np.ndarray:
    """Return the point of the surface in the middle of an image of odd size."""
    vertices = spherical_map.mesh.vertices
    return geometry_image(spherical_map, vertices, 5, cut)[:, 2, 2]


def test_the_highest_point_above_the_centroid_is_in_the_middle_of_every_image(star_map) -> None:
    spherical_map = lopsided(star_map)
    mesh = spherical_map.mesh
    centroid = mesh.triangles_center.T @ mesh.area_faces / mesh.area
    # Second route: the surface cut by a plane through the axis, its segments where they meet it.
    start, end = mesh_plane(mesh, [1, 0, 0], centroid).transpose(1, 0, 2)
    share = (centroid[1] - start[:, 1]) / (end[:, 1] - start[:, 1])
    met = (start + share[:, None] * (end - start))[(share >= 0) & (share <= 1)]
    highest = met[met[:, 2].argmax()]
    cuts = upright_cuts(spherical_map)
    assert len(cuts) == 12
    for cut in cuts[::5]:
        assert_allclose(shown_at_the_centre(spherical_map, cut), highest, atol=1e-9)


def test_turns_about_the_pole_are_equal_and_a_quarter_turns_the_image(star_map) -> None:
    spherical_map = lopsided(star_map)
    cuts = upright_cuts(spherical_map)
    steps = (cuts[1:] * cuts[:-1].inv()).as_rotvec()
    assert_allclose(steps, np.tile([0, 0, np.pi / 6], (11, 1)), atol=1e-12)
    images = lookup(spherical_map, 8, cuts, "equal-area").render(spherical_map.mesh.vertices)
    assert_allclose(images[3:], np.rot90(images[:-3], axes=(2, 3)), atol=1e-5)


@given(angle=st.floats(-10, 10), shift=st.floats(-5, 5))
@settings(max_examples=10)
def test_images_turn_with_the_pose_and_an_azimuth_undoes_it(
    star_map, angle: float, shift: float
) -> None:
    spherical_map = lopsided(star_map)
    turn = Rotation.from_rotvec([0, 0, angle])
    mesh = spherical_map.mesh
    posed = trimesh.Trimesh(turn.apply(mesh.vertices) + shift, mesh.faces, process=False)
    # The map is one of the surface: it does not know the pose, nor does any turn of it matter.
    turned = SphericalMap(posed, Rotation.from_rotvec([2.0, 1, shift]).apply(spherical_map.sphere))
    expected = upright_cuts(spherical_map).apply(spherical_map.sphere[7])
    found = upright_cuts(turned, azimuth=-angle).apply(turned.sphere[7])
    assert_allclose(found, expected, atol=1e-6)


def test_a_sphere_under_the_identity_stays_as_it_is(sphere_map) -> None:
    cut = upright_cuts(sphere_map, turns=1)
    assert_allclose(cut[0].as_matrix(), np.eye(3), atol=1e-9)


def test_where_the_axis_misses_the_surface_the_nearest_and_highest_vertex_is_taken() -> None:
    torus = trimesh.creation.torus(1.0, 0.4, 32, 16)
    torus.vertices[:, 0] *= 1.1
    corners, weights = highest_on_axis(torus, np.zeros(3))
    point = weights @ torus.vertices[corners]
    assert_allclose(np.abs(point), [0, 0.6, 0], atol=1e-9)
    box = trimesh.creation.box()
    corners, weights = highest_on_axis(box, np.array([5.0, 0.1, 0.0]))
    assert (weights @ box.vertices[corners])[[0, 2]].tolist() == [0.5, 0.5]


@pytest.mark.parametrize("point", [[0.5, 0.5], [0.25, 0.0], [0.5, 0.2], [0.1, 0.3]])
def test_an_axis_through_a_vertex_or_an_edge_is_no_miss(point) -> None:
    box = trimesh.creation.box()
    corners, weights = highest_on_axis(box, np.array([*point, 0.0]))
    assert weights.min() >= 0
    assert_allclose(weights @ box.vertices[corners], [*point, 0.5], atol=1e-12)
