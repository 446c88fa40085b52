from __future__ import annotations

import numpy as np

from gipkg.surfaces.halfedges import corners_by_vertex, label_connected


def test_corners_are_grouped_by_their_vertex():
    start, corners = corners_by_vertex(np.array([[0, 3, 1], [1, 3, 4]]), 6)
    groups = [group.tolist() for group in np.split(corners, start[1:-1])]
    assert start[-1] == len(corners)
    assert groups == [[0], [2, 3], [], [1, 4], [5], []]


def test_what_nothing_is_joined_to_is_a_set_of_its_own():
    count, label = label_connected(5, np.array([4, 0, 0]), np.array([2, 1, 1]))
    assert count == 3
    assert label[4] == label[2]
    assert label[0] == label[1]
    assert len({label[0], label[2], label[3]}) == 3
