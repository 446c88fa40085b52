"""Forward kinematics, contact, and the flesh on a skeleton, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gipkg.datasets.articulated.flesh import isosurface, lattice_spacing
from gipkg.datasets.articulated.remesh import genus
from gipkg.datasets.articulated.skeleton import Skeleton


def test_limb_turns_one_joint_after_the_other():
    skeleton = Skeleton()
    root = skeleton.ball([1.0, 0.0, 0.0], 0.2)
    left = Rotation.from_euler("Z", 90, degrees=True)
    nodes = skeleton.limb(root, left, [1.0, 2.0, 3.0], [0.1] * 3, [left, left])
    expected = [[1, 1, 0], [-1, 1, 0], [-1, -2, 0]]
    np.testing.assert_allclose([skeleton.centre(node) for node in nodes], expected, atol=1e-12)


def test_limb_starts_as_thick_as_it_is_and_keeps_the_ball_of_its_root():
    skeleton = Skeleton()
    root = skeleton.ball([0.0, 0.0, 0.0], 0.5)
    skeleton.limb(root, Rotation.identity(), [2.0], [0.1])
    ends, radii = skeleton.cones()
    assert radii.tolist() == [[0.1, 0.1], [0.5, 0.5]]
    assert ends.tolist() == [[[0, 0, 0], [2, 0, 0]], [[0, 0, 0], [0, 0, 0]]]


def hairpin(distance: float) -> Skeleton:
    """Two parallel bones at a distance, joined at one end."""
    skeleton = Skeleton()
    node = skeleton.ball([0.0, 0.0, 0.0], 0.1)
    for point in ([3.0, 0.0, 0.0], [3.0, distance, 0.0], [0.0, distance, 0.0]):
        node = skeleton.ball(point, 0.1, node)
    return skeleton


@pytest.mark.parametrize(("distance", "touches"), [(0.29, True), (0.31, False)])
def test_contact_is_a_gap_too_small_between_distant_parts(distance, touches):
    assert hairpin(distance).touches_itself(gap=0.1) is touches


def test_a_straight_chain_never_touches_itself():
    skeleton = Skeleton()
    root = skeleton.ball([0.0, 0.0, 0.0], 0.3)
    skeleton.limb(root, Rotation.identity(), [0.2] * 9, [0.3] * 9, [Rotation.identity()] * 8)
    assert not skeleton.touches_itself(gap=0.1)


def enclosed_volume(vertices, faces) -> float:
    return np.linalg.det(vertices[faces]).sum() / 6


def test_one_bone_is_a_capsule():
    skeleton = Skeleton()
    skeleton.ball([2.0, 1.0, 0.0], 0.3, skeleton.ball([1.0, -1.0, 2.0], 0.3))
    vertices, faces = isosurface(skeleton, blending=0.05, spacing=0.03)
    assert genus(faces, len(vertices)) == 0
    expected = np.pi * 0.09 * 3 + 4 / 3 * np.pi * 0.027
    assert enclosed_volume(vertices, faces) == pytest.approx(expected, rel=5e-3)


def test_ring_of_bones_has_a_hole():
    skeleton = Skeleton()
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    nodes = [skeleton.ball([np.cos(a), np.sin(a), 0.0], 0.2) for a in angle]
    for first, second in zip(nodes, nodes[1:] + nodes[:1], strict=True):
        skeleton.join(first, second)
    vertices, faces = isosurface(skeleton, blending=0.02, spacing=0.05)
    assert genus(faces, len(vertices)) == 1


def test_blending_fills_the_crease_between_two_bones():
    skeleton = Skeleton()
    root = skeleton.ball([0.0, 0.0, 0.0], 0.2)
    for angle in (-0.5, 0.5):
        skeleton.limb(root, Rotation.from_euler("Z", angle), [2.0], [0.2])
    sharp, soft = (
        enclosed_volume(*isosurface(skeleton, blending, spacing=0.04)) for blending in (0.01, 0.06)
    )
    assert soft > 1.03 * sharp


@pytest.mark.parametrize("size", [300, 3000])
def test_lattice_leaves_vertices_to_decimate(size):
    skeleton = hairpin(1.0)
    vertices, _ = isosurface(skeleton, blending=0.03, spacing=lattice_spacing(skeleton, size))
    assert len(vertices) > 1.5 * size
