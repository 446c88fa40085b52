from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from gipkg.baselines.light_field.cameras import alignments, attitudes, axes, directions


def test_the_axes_are_those_of_a_dodecahedron() -> None:
    cosines = np.abs(axes() @ axes().T)
    # Every vertex sees the others, and their opposites, at two angles: √5 / 3 and 1 / 3.
    expected = [1 / 3] * 6 + [np.sqrt(5) / 3] * 3 + [1]
    assert_allclose(np.sort(cosines, axis=1), np.tile(expected, (10, 1)), atol=1e-12)


def test_the_alignments_are_the_group_of_its_rotations() -> None:
    group = {tuple(row) for row in alignments()}
    assert len(group) == 60
    assert tuple(range(10)) in group
    assert all(sorted(row) == list(range(10)) for row in group)
    assert {tuple(np.array(one)[list(other)]) for one in group for other in group} == group


def test_an_alignment_turns_the_axes_as_a_rotation_does() -> None:
    for permutation in alignments():
        cosines = np.abs(axes()[permutation] @ axes()[permutation].T)
        assert_allclose(cosines, np.abs(axes() @ axes().T), atol=1e-12)


def test_the_cameras_are_turned_dodecahedra() -> None:
    assert_allclose(np.linalg.det(attitudes()), 1)
    assert_allclose(np.linalg.norm(directions(), axis=2), 1)
    assert_allclose(directions()[3], Rotation.from_matrix(attitudes()[3]).apply(axes()), atol=1e-12)


def test_some_pair_of_attitudes_comes_near_to_any_rotation() -> None:
    cameras, group = Rotation.from_matrix(attitudes()), Rotation.create_group("I")
    relative = np.concatenate(
        [(one * group * other.inv()).as_quat() for one in cameras for other in cameras]
    )
    assert len(relative) == 6000
    any_rotation = Rotation.random(1000, rng=np.random.default_rng(0)).as_quat()
    cosine = np.abs(any_rotation @ relative.T).max(axis=1).clip(max=1)
    angle = np.degrees(2 * np.arccos(cosine))
    assert angle.mean() < 8
    assert angle.max() < 20
