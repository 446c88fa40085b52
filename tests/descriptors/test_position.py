"""Positions, heights and distances: closed forms on shapes that lie somewhere else."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from gipkg.descriptors import describe

SHIFT = np.array([3.0, -1.0, 7.0])


def moved(mesh: trimesh.Trimesh, scale: float = 5.0) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices * scale + SHIFT, mesh.faces, process=False)


def test_the_centroid_is_that_of_the_area_and_the_unit_its_root() -> None:
    """A cone's mantle has its centroid at a third of its height, its base on the ground."""
    cone = trimesh.creation.cone(1.0, 2.0, sections=200)
    slope = np.sqrt(5.0)
    area = np.pi * (1 + slope)
    centroid = np.pi * slope * (2 / 3) / area
    mesh = moved(cone.subdivide().subdivide())
    expected = (cone.subdivide().subdivide().vertices - [0, 0, centroid]) / np.sqrt(area)
    assert_allclose(describe(mesh, "position"), expected, atol=2e-3)
    assert_allclose(describe(mesh, "height"), expected[:, 2:], atol=2e-3)


def test_every_point_of_a_sphere_is_as_far_from_the_centroid() -> None:
    distance = describe(moved(trimesh.creation.icosphere(4)), "centroid-distance")
    assert_allclose(distance, 1 / np.sqrt(4 * np.pi), rtol=2e-3)


def test_it_is_the_distance_on_torus_cylinder_and_ellipsoid() -> None:
    torus = trimesh.creation.torus(1.0, 0.4, 48, 48)
    from_axis = np.linalg.norm(torus.vertices[:, :2], axis=1)
    root = np.sqrt(4 * np.pi**2 * 0.4)
    expected = np.hypot(from_axis, torus.vertices[:, 2]) / root
    assert_allclose(describe(moved(torus), "centroid-distance")[:, 0], expected, rtol=5e-3)
    cylinder = trimesh.creation.cylinder(0.5, 3.0, sections=128)
    corner = np.hypot(0.5, 1.5) / np.sqrt(2 * np.pi * 0.5 * 3.5)
    found = describe(moved(cylinder), "centroid-distance")[:, 0]
    on_rim = np.linalg.norm(cylinder.vertices[:, :2], axis=1) > 0.4
    assert_allclose(found[on_rim], corner, rtol=1e-3)
    ellipsoid = trimesh.creation.icosphere(4)
    ellipsoid.apply_scale([1.0, 1.5, 2.5])
    expected = np.linalg.norm(ellipsoid.vertices, axis=1) / np.sqrt(ellipsoid.area)
    assert_allclose(describe(moved(ellipsoid), "centroid-distance")[:, 0], expected, rtol=1e-9)


def test_the_three_are_one_geometry(pebble) -> None:
    position = describe(pebble, "position")
    assert_allclose(describe(pebble, "height")[:, 0], position[:, 2])
    assert_allclose(describe(pebble, "centroid-distance")[:, 0], np.linalg.norm(position, axis=1))


def test_a_turn_about_the_upright_axis_turns_positions_and_keeps_heights(pebble) -> None:
    turn = Rotation.from_euler("z", 0.7)
    turned = trimesh.Trimesh(turn.apply(pebble.vertices), pebble.faces, process=False)
    assert_allclose(describe(turned, "position"), turn.apply(describe(pebble, "position")))
    assert_allclose(describe(turned, "height"), describe(pebble, "height"))
