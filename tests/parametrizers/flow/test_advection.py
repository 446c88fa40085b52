"""Advection on the sphere against rotations and against a density with a closed form."""

import numpy as np
import pytest

from gipkg.parametrizers.flow.advection import advect
from gipkg.parametrizers.flow.lie import LieFlow
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.surfaces.halfedges import twins
from tests.support.shapes import icosphere

MESH = icosphere(4)
SPHERE, FACES = np.array(MESH.vertices), np.asarray(MESH.faces, np.int64)


@pytest.mark.parametrize("density", [0.2, 1.0, 5.0])
def test_a_rotation_turns_by_its_angle_over_the_density(density: float) -> None:
    rng = np.random.default_rng(0)
    points = rng.standard_normal((200, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    before, hosts, steps = points.copy(), np.zeros(len(points), np.int64), 50
    times = np.arange(steps) / steps
    for time in times:
        advect(
            points, hosts, SPHERE, FACES, twins(FACES), np.cross([0, 0, 1.0], SPHERE),
            np.full(len(SPHERE), density), time, 1 / steps,
        )  # fmt: skip
    angle = np.sum(1 / steps / ((1 - times) * density + times))
    expected = before[:, 0] + 1j * before[:, 1]
    expected *= np.exp(1j * angle)
    # Euler's steps leave the parallels for the great circles that touch them.
    np.testing.assert_allclose(points[:, 0] + 1j * points[:, 1], expected, atol=0.02 * angle**2)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1, atol=1e-14)


def test_a_density_that_depends_on_height_flows_along_meridians_to_where_it_must() -> None:
    centres = SPHERE[FACES].mean(axis=1)[:, 2]
    areas = (1 + 0.8 * centres) * signed_spherical_areas(SPHERE, FACES)
    flow = LieFlow(SPHERE, FACES, areas * (4 * np.pi / areas.sum()))
    for number in range(100):
        flow.advance(number / 100, 0.01)
    height = SPHERE[:, 2]
    # The mass above a parallel, ∫(1 + 0.8 s) ds, is the area above the one it moves to.
    np.testing.assert_allclose(flow.points[:, 2], height - 0.4 * (1 - height**2), atol=0.01)
    turn = np.cross(SPHERE, flow.points)[:, 2]
    np.testing.assert_allclose(turn, 0, atol=0.01)


def test_points_are_found_wherever_the_walk_begins() -> None:
    still = np.zeros_like(SPHERE)
    points = SPHERE[FACES].mean(axis=1)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    hosts = np.random.default_rng(0).integers(len(FACES), size=len(points))
    advect(points, hosts, SPHERE, FACES, twins(FACES), still, np.ones(len(SPHERE)), 0.0, 0.1)
    np.testing.assert_array_equal(hosts, np.arange(len(FACES)))
