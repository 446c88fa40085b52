"""The lattice: simple voxels against homology, Euler characteristics against known solids."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest

from gipkg.surfaces.volumes.lattice import NEIGHBOURS, euler_characteristic, label, simple_links
from gipkg.surfaces.volumes.topology import count_topology, fill_cavities, largest_component
from tests.surfaces.volumes.solids import ball, blobs, ring


def rank_over_two_elements(matrix: np.ndarray) -> int:
    matrix, rank = matrix.copy() % 2, 0
    for column in matrix.T:
        pivots = np.flatnonzero(column[rank:]) + rank
        if len(pivots):
            matrix[[rank, pivots[0]]] = matrix[[pivots[0], rank]]
            others = np.flatnonzero(matrix[:, np.flatnonzero(matrix[rank])[0]])
            matrix[others[others != rank]] ^= matrix[rank]
            rank += 1
    return rank


def betti_numbers(points: list[tuple[int, ...]]) -> list[int]:
    """Betti numbers over two elements of the clique complex, as a chain of boundary ranks."""
    steps = {tuple(step) for step in NEIGHBOURS.tolist()}

    def beside(p, q):
        return tuple(np.subtract(p, q).tolist()) in steps

    simplices = [[(p,) for p in sorted(points)]]
    for _ in range(2):
        simplices.append(
            [
                (*simplex, point[0])
                for simplex in simplices[-1]
                for point in simplices[0]
                if point[0] > simplex[-1] and all(beside(point[0], p) for p in simplex)
            ]
        )
    ranks = [0]
    for lower, upper in pairwise(simplices):
        place = {simplex: row for row, simplex in enumerate(lower)}
        boundary = np.zeros((len(lower), len(upper)), np.int64)
        for column, simplex in enumerate(upper):
            for face in combinations(simplex, len(simplex) - 1):
                boundary[place[face], column] = 1
        ranks.append(rank_over_two_elements(boundary))
    ranks.append(0)
    return [len(some) - ranks[k] - ranks[k + 1] for k, some in enumerate(simplices)]


def test_the_link_of_a_voxel_is_a_sphere():
    assert betti_numbers([tuple(step) for step in NEIGHBOURS.tolist()]) == [1, 0, 1]


def test_simple_voxels_are_those_whose_solid_link_is_a_point_up_to_homology():
    table = simple_links()
    chosen = np.random.default_rng(0).choice(len(table), 600, replace=False)
    # By size too: the few neighbours and the many are rare among random ones.
    small = [bits for bits in range(len(table)) if bits.bit_count() in (0, 1, 13, 14)]
    for bits in [*small, *chosen.tolist()]:
        link = [tuple(step) for k, step in enumerate(NEIGHBOURS.tolist()) if bits >> k & 1]
        assert table[bits] == (bool(link) and betti_numbers(link) == [1, 0, 0])


def test_simple_is_symmetric_in_solid_and_background():
    table = simple_links()
    assert np.array_equal(table, table[::-1])


def test_removing_a_simple_voxel_keeps_all_three_counts():
    solid = np.pad(blobs(3, size=8), 1)
    before = count_topology(solid)
    seen = {True: 0, False: 0}
    for voxel in np.argwhere(solid):
        link = sum(int(solid[tuple(voxel + step)]) << k for k, step in enumerate(NEIGHBOURS))
        simple = bool(simple_links()[link])
        without = solid.copy()
        without[tuple(voxel)] = False
        after = count_topology(without)
        same = (after.components, after.cavities, after.tunnels) == (
            before.components,
            before.cavities,
            before.tunnels,
        )
        assert same or not simple
        seen[simple] += 1
    assert min(seen.values()) > 20


@pytest.mark.parametrize(
    ("solid", "counts"),
    [
        (ball(9), (1, 0, 0)),
        (ball(12) & ~ball(6), (1, 1, 0)),
        (ring(11, 4), (1, 0, 1)),
        (ring(8, 3, (-7, 0, 0)) | ring(8, 3, (7, 0, 0)), (1, 0, 2)),
        (ball(7, (-9, 0, 0)) | ball(5, (9, 0, 0)), (2, 0, 0)),
        (ring(9, 2.5, (-5, 0, 0)) | ring(9, 2.5, (5, 0, 0), axis=1), (2, 0, 2)),
        (ball(15) & ~ring(8, 3), (1, 1, 1)),
        (np.zeros((3, 4, 5), bool), (0, 0, 0)),
        (np.ones((3, 4, 5), bool), (1, 0, 0)),
    ],
)
def test_known_solids_are_counted(solid, counts):
    found = count_topology(solid)
    assert (found.components, found.cavities, found.tunnels) == counts
    assert found.voxels == solid.sum()
    assert euler_characteristic(solid) == counts[0] + counts[1] - counts[2]


def test_neighbours_lie_along_one_diagonal_of_a_cube_only():
    corner = np.zeros((2, 2, 2), bool)
    corner[0, 0, 0] = corner[1, 1, 1] = True
    assert label(corner)[1] == 1
    assert label(corner[::-1])[1] == 2


def test_the_largest_component_and_its_share():
    small, large = ball(5, (9, 0, 0)), ball(7, (-9, 0, 0))
    kept, share = largest_component(small | large)
    assert np.array_equal(kept, large)
    assert share == large.sum() / (small.sum() + large.sum())


def test_cavities_are_filled_and_bays_are_not():
    shell = ball(12) & ~ball(6)
    assert np.array_equal(fill_cavities(shell), ball(12))
    bowl = shell.copy()
    bowl[19:21, 19:21, 20:] = False
    assert np.array_equal(fill_cavities(bowl), bowl)
