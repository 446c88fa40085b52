from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
import trimesh
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.baselines.voxnet.baseline import EXTENT, SIZE, VoxNet
from gipkg.baselines.voxnet.network import JITTER, Dropout, VoxelNetwork, shifted
from gipkg.descriptors.operators import Operators
from gipkg.learning import training
from gipkg.testing import meshes

SMALL = VoxNet(rotations=4, epochs=1, minimum_steps=30)


def represent(baseline: VoxNet, mesh: trimesh.Trimesh) -> np.ndarray:
    return baseline.represent(mesh, Operators(mesh))


def solids() -> dict[str, np.ndarray]:
    """Long and flat ellipsoids, whose first letter is their class."""
    axes = {"l": (1.0, 1.0, 2.0), "f": (1.0, 2.0, 2.0)}
    return {
        f"{label}{n}": represent(SMALL, meshes.ellipsoid(tuple(sides + 0.1 * n), subdivisions=2))
        for label, sides in ((label, np.array(sides)) for label, sides in axes.items())
        for n in range(4)
    }


SHAPES = solids()
TRAIN = {i: i[0] for i in SHAPES if i[1] in "02"}
TEST = tuple(i for i in SHAPES if i not in TRAIN)


def test_a_network_learns_solids_and_shapes_of_a_class_are_near() -> None:
    found = SMALL.predict(SHAPES, TRAIN, TEST, device="cpu")
    assert [found.classes[k] for k in found.scores.argmax(axis=1)] == [i[0] for i in TEST]
    assert_allclose(found.scores.sum(axis=1), 1, rtol=1e-5)
    assert found.embeddings.shape == (len(TEST), 128)
    distances = found.pairwise_distances()
    assert distances[0, 1] < distances[0, 2:].min()


def test_a_killed_training_ends_as_an_undisturbed_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With dropout, random shifts and all."""
    brief = SMALL.model_copy(update={"minimum_steps": 4})
    expected = brief.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu")
    monkeypatch.setattr(training, "SECONDS_BETWEEN_CHECKPOINTS", 0.0)
    descend, steps = training._descend, []

    def killed(*arguments: object) -> None:
        if len(steps) == 2:
            raise KeyboardInterrupt
        steps.append(descend(*arguments))

    monkeypatch.setattr(training, "_descend", killed)
    checkpoint = tmp_path / "state.pt"
    with pytest.raises(KeyboardInterrupt):
        brief.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    monkeypatch.setattr(training, "_descend", descend)
    found = brief.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    assert_array_equal(found.scores, expected.scores)
    assert_array_equal(found.embeddings, expected.embeddings)


def test_the_network_is_as_published() -> None:
    """Weights and biases of C(32, 5, 2), C(32, 3, 1), P(2), FC(128), FC(k) on 32 voxels."""
    network = VoxelNetwork(SIZE, 40)
    convolutions = 32 * (5**3 + 1) + 32 * (32 * 3**3 + 1)
    assert sum(p.numel() for p in network.parameters()) == (
        convolutions + 128 * (32 * 6**3 + 1) + 40 * (128 + 1)
    )


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16])
@pytest.mark.parametrize("share", [0.0, 0.2, 0.5])
def test_dropout_drops_its_share_and_keeps_the_mean(share: float, dtype: torch.dtype) -> None:
    torch.manual_seed(0)
    units = torch.ones(3, 33_333, dtype=dtype, requires_grad=True)
    dropout = Dropout(share)
    seen = dropout(units)
    assert seen.dtype == dtype
    kept = seen.detach() != 0
    assert (1 - kept.double().mean()).item() == pytest.approx(share, abs=0.006)
    torch.testing.assert_close(seen[kept], torch.full_like(seen[kept], 1 / (1 - share)))
    seen.sum().backward()
    assert torch.equal(units.grad, seen.detach())
    # Neighbours, which share a random number, are as independent as others are.
    pairs = (~kept).flatten()[:-1].unflatten(0, (-1, 2)).all(1) if share else torch.zeros(1)
    assert pairs.double().mean().item() == pytest.approx(share**2, abs=0.01)
    assert torch.equal(dropout.eval()(units), units)


def test_grids_are_shifted_each_by_itself_within_the_margin() -> None:
    assert (SIZE - EXTENT) // 2 >= JITTER
    torch.manual_seed(0)
    grid = torch.zeros(8, 8, 8, dtype=torch.bool)
    grid[3, 4, 5] = True
    moved = shifted(grid.expand(500, -1, -1, -1), JITTER)
    assert moved.flatten(1).sum(1).eq(1).all()
    shifts = moved.nonzero()[:, 1:].numpy() - [3, 4, 5]
    assert_array_equal(np.unique(shifts), np.arange(-JITTER, JITTER + 1))
    assert len(np.unique(shifts, axis=0)) > 100


def test_a_network_that_predicts_shifts_nothing() -> None:
    network = VoxelNetwork(SIZE, 2).eval()
    grids = torch.from_numpy(SHAPES["l0"])
    with torch.inference_mode():
        assert torch.equal(network(grids)[0], network(grids)[0])


def test_without_an_upright_axis_a_turned_shape_has_the_same_rotations() -> None:
    """In another order: what is left open is half a turn, which is one of them."""
    mesh = meshes.limbed()
    turned = meshes.moved(mesh, np.random.default_rng(3))
    expected, found = (represent(SMALL, one) for one in (mesh, turned))
    changed = min((np.roll(found, k, axis=0) != expected).sum() for k in (0, 2))
    assert changed < 1e-3 * expected.sum()


def test_with_an_upright_axis_a_shape_keeps_its_pose() -> None:
    baseline = VoxNet(rotations=4, upright="z")
    box = trimesh.creation.box(extents=(1, 2, 3))
    grids = represent(baseline, box)
    filled = [np.ptp(np.argwhere(grid), axis=0) + 1 for grid in grids]
    assert_allclose(filled, [[8, 16, 24], [16, 8, 24], [8, 16, 24], [16, 8, 24]], atol=1)
