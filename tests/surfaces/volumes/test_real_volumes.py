"""Real volumes: McGill's hard ones, and a ModelNet grid of several parts."""

from __future__ import annotations

import numpy as np
import pytest

from gipkg.api import Volume
from gipkg.datasets.mcgill import McGill
from gipkg.surfaces import prepare
from tests.surfaces.solids import assert_genus_zero


@pytest.mark.parametrize(
    ("shape_id", "components", "cavities", "tunnels"),
    [
        ("ants-1", 1, 0, 0),
        ("birds-b8", 6, 0, 0),
        ("chairs-b19", 1, 0, 3),
        ("crabs-25", 1, 0, 9),
        ("hands-b20", 1, 2, 0),
    ],
)
def test_mcgill_volumes_are_of_genus_zero(data_root, shape_id, components, cavities, tunnels):
    dataset = McGill()
    if not dataset.available(data_root):
        pytest.skip(f"no McGill under {data_root}")
    volume = dataset.load(data_root, shape_id)
    surface = prepare(volume)
    assert_genus_zero(surface.mesh)
    assert len(surface.mesh.vertices) == 3000
    before = surface.report.before
    assert (before.components, before.cavities, before.tunnels) == (components, cavities, tunnels)
    assert surface.mesh.volume == pytest.approx(volume.values.sum(), rel=0.06)


def test_grids_of_many_parts_are_joined(data_root):
    path = data_root / "modelnet10" / "modelnet10_voxel30.npz"
    if not path.is_file():
        pytest.skip(f"no {path}")
    with np.load(path) as archive:
        grids = archive["X_test"]
    joined = 0
    for grid in grids[::100]:
        surface = prepare(Volume(grid), components="joined", vertices=800)
        assert_genus_zero(surface.mesh)
        joined += not surface.mask.all()
    assert joined
