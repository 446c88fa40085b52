"""Tips are found where limbs end, and nowhere else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from gipkg.datasets.articulated import Articulated
from gipkg.reporting.tips import AREA, limb_tips, vertex_shares


@pytest.mark.parametrize(("label", "limbs"), [("hands", 5), ("octopuses", 8), ("humans", 5)])
def test_every_limb_has_a_tip(label: str, limbs: int) -> None:
    mesh = Articulated().load(Path(), f"{label}-003")
    tips = limb_tips(mesh)
    assert len(tips.vertex) == limbs
    sizes = vertex_shares(mesh)
    for tip, vertex in enumerate(tips.vertex):
        inside = tips.region == tip
        assert inside[vertex]
        assert AREA - sizes.max() < sizes[inside].sum() <= AREA
    # Regions are apart: they are shares of limbs of their own.
    assert set(tips.region) == {-1, *range(limbs)}


def test_a_ball_has_none() -> None:
    assert limb_tips(trimesh.creation.icosphere(subdivisions=3)).vertex.size == 0


def test_a_rod_has_its_two_ends() -> None:
    rod = trimesh.creation.capsule(height=10.0, radius=0.5, count=(16, 32))
    rod = rod.subdivide_to_size(0.7)
    tips = limb_tips(rod)
    assert len(tips.vertex) == 2
    low, high = np.sort(rod.vertices[tips.vertex][:, 2])
    assert low < -5 < 5 < high  # on the two caps


def test_the_order_of_the_vertices_does_not_matter(hand: trimesh.Trimesh) -> None:
    order = np.random.default_rng(3).permutation(len(hand.vertices))
    place = np.argsort(order)
    shuffled = trimesh.Trimesh(hand.vertices[order], place[hand.faces], process=False)
    assert set(order[limb_tips(shuffled).vertex]) == set(limb_tips(hand).vertex)


def test_vertices_share_the_area_of_their_faces(hand: trimesh.Trimesh) -> None:
    around = [hand.area_faces[faces[faces >= 0]].sum() / 3 for faces in hand.vertex_faces]
    assert vertex_shares(hand) == pytest.approx(np.array(around) / hand.area)
