"""What is said of a shape does not depend on the shapes beside it, nor on their order."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import gipkg
from gipkg.datasets.articulated import Articulated
from gipkg.shards import Arrays, Shard, map_shard, shard_of

PLUGIN = Articulated(per_class=2, min_vertices=300, max_vertices=330)
IDS = [shape.id for shape in PLUGIN.shapes(Path())][:10:2]


def everything(shape_id: str) -> Arrays:
    """Take a shape through all stages that work shape by shape."""
    surface = gipkg.prepare(PLUGIN.load(Path(), shape_id)).mesh
    spherical_map = gipkg.parametrize(surface)
    signature = gipkg.describe(surface, "hks", times=3)
    return {
        "vertices": np.asarray(surface.vertices),
        "sphere": spherical_map.sphere,
        "signature": signature,
        "image": gipkg.geometry_image(spherical_map, signature, size=24),
    }


def made(folder: Path, count: int) -> dict[str, dict[str, bytes]]:
    """Compute all shapes in so many shards, and return their arrays as bytes."""
    found = {}
    for number in range(count):
        ids = [one for one in IDS if shard_of(one, count) == number]
        out = folder / f"{number}.npz"
        map_shard(ids, everything, out, folder / "work", "test", key="k")
        shard = Shard.open(out)
        assert shard.failures == {}
        found |= {
            one: {name: array.tobytes() for name, array in shard[one].items()} for one in shard
        }
    return found


def test_one_shard_and_four_say_the_same(tmp_path: Path) -> None:
    one, four = made(tmp_path / "one", 1), made(tmp_path / "four", 4)
    assert len({shard_of(shape_id, 4) for shape_id in IDS}) > 1
    assert set(one) == set(four) == set(IDS)
    assert one == four
