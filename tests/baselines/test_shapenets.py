from __future__ import annotations

from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest
import torch
import trimesh
from numpy.testing import assert_allclose, assert_array_equal
from torch.nn.functional import conv3d

from gipkg.baselines.shapenets import baseline as baseline_module
from gipkg.baselines.shapenets import pretraining
from gipkg.baselines.shapenets.baseline import EXTENT, KERNELS, SIZE, STRIDES, ShapeNets
from gipkg.baselines.shapenets.belief import BeliefNetwork, BoltzmannMachine, spread
from gipkg.baselines.shapenets.bits import pack, unpack
from gipkg.baselines.shapenets.network import ShapeNetsNetwork
from gipkg.baselines.shapenets.pretraining import Pretraining, pretrain
from gipkg.baselines.voxels import turned_solids
from gipkg.descriptors.operators import Operators
from gipkg.errors import LearningError
from gipkg.learning import training
from gipkg.learning.device import reproducible
from gipkg.testing import meshes

SMALL = ShapeNets(
    rotations=2, maps=(4, 8, 8), widths=(16, 12), epochs=1, learning_rate=0.01, pretraining_rate=10
)


def represent(baseline: ShapeNets, mesh: trimesh.Trimesh) -> np.ndarray:
    return baseline.represent(mesh, Operators(mesh))


def solids() -> dict[str, np.ndarray]:
    """Long and flat ellipsoids, whose first letter is their class."""
    sides = {"l": np.array((1.0, 1.0, 2.0)), "f": np.array((1.0, 2.0, 2.0))}
    return {
        f"{label}{n}": represent(
            SMALL, meshes.ellipsoid(tuple(sides[label] + 0.1 * n), subdivisions=2)
        )
        for label in sides
        for n in range(4)
    }


SHAPES = solids()
TRAIN = {i: i[0] for i in SHAPES if i[1] in "02"}
TEST = tuple(i for i in SHAPES if i not in TRAIN)
VIEWS = torch.from_numpy(np.stack([SHAPES[i] for i in TRAIN]))


def machine(size: int = 3, features: int = 2) -> BoltzmannMachine:
    torch.manual_seed(0)
    made = BoltzmannMachine(1, size, features, kernel=2, stride=1)
    for parameter in made.parameters():
        torch.nn.init.normal_(parameter, std=0.7)
    return made.double()


def energy(made: BoltzmannMachine, visible: torch.Tensor, hidden: torch.Tensor) -> torch.Tensor:
    """The definition, unit by unit; (B,)."""
    pieces = visible.unfold(2, 2, 1).unfold(3, 2, 1).unfold(4, 2, 1)
    drive = torch.einsum("bcxyzijk,fcijk->bfxyz", pieces, made.convolution.weight)
    coupled = (hidden * (drive + made.convolution.bias.view(-1, 1, 1, 1))).flatten(1).sum(1)
    return -coupled - (visible * made.visible_bias).flatten(1).sum(1)


def test_bits_are_unpacked_in_their_places_with_the_packed_axis_first() -> None:
    grids = np.random.default_rng(0).random((5, SIZE, SIZE, SIZE)) < 0.3
    packed = pack(grids)
    assert packed.nbytes < grids.nbytes / 7
    found = unpack(torch.from_numpy(packed).permute(0, 3, 1, 2), SIZE)
    assert found.shape == (5, 1, SIZE, SIZE, SIZE)
    assert_array_equal(found[:, 0].permute(0, 2, 3, 1).numpy(), grids)


def test_a_representation_is_the_solids_of_all_rotations() -> None:
    box = trimesh.creation.box(extents=(1, 2, 3))
    upright = ShapeNets(rotations=4, upright="z")
    found = np.unpackbits(represent(upright, box), axis=3, count=SIZE).astype(bool)
    assert_array_equal(found, turned_solids(box, 4, SIZE, EXTENT))
    assert found[0].any(axis=(0, 1)).sum() == EXTENT


@pytest.mark.parametrize(("kernel", "stride"), [(6, 2), (5, 2), (4, 1), (3, 3), (2, 3)])
def test_spreading_is_the_transposed_convolution(kernel: int, stride: int) -> None:
    rng = torch.Generator().manual_seed(0)
    hidden = torch.rand(2, 4, 3, 3, 3, generator=rng, dtype=torch.double)
    weight = torch.randn(4, 5, kernel, kernel, kernel, generator=rng, dtype=torch.double)
    expected = torch.nn.functional.conv_transpose3d(hidden, weight, stride=stride)
    torch.testing.assert_close(spread(hidden, weight, stride), expected)


def test_probabilities_are_those_of_the_energy() -> None:
    """Of every unit, by the energies of its two states, all others fixed."""
    made = machine()
    rng = torch.Generator().manual_seed(1)
    visible = torch.rand(1, 1, 3, 3, 3, generator=rng).round().double()
    hidden = torch.rand(1, 2, 2, 2, 2, generator=rng).round().double()
    for probabilities, units in ((made(visible), hidden), (made.reconstruct(hidden), visible)):
        for place in product(*map(range, units.shape)):
            on, off = units.clone(), units.clone()
            on[place], off[place] = 1, 0
            pairs = [(visible, one) if units is hidden else (one, hidden) for one in (on, off)]
            gap = energy(made, *pairs[1]) - energy(made, *pairs[0])
            torch.testing.assert_close(probabilities[place], torch.sigmoid(gap[0]))


def test_the_contrast_is_the_difference_of_free_energies_summed_over_all_hidden_states() -> None:
    made = machine(features=1)
    rng = torch.Generator().manual_seed(2)
    data, sampled = torch.rand(2, 1, 1, 3, 3, 3, generator=rng).double() + 0.01
    states = torch.tensor(list(product((0.0, 1.0), repeat=8))).double().view(-1, 1, 2, 2, 2)

    def free_energy(visible: torch.Tensor) -> torch.Tensor:
        return -torch.logsumexp(
            -energy(made, visible.expand(len(states), -1, -1, -1, -1), states), 0
        )

    with torch.no_grad():
        made.visible_bias.zero_()
        expected = (free_energy(data) - free_energy(sampled)) / 8  # In mean over 8 places.
        found = made.contrast(data, made.convolution(data), sampled, 0.0, 0.0)
        torch.testing.assert_close(found, expected)


def test_its_gradient_is_that_of_contrastive_divergence() -> None:
    """Correlations of data and hidden units less those of the sample, and the means."""
    made = machine()
    rng = torch.Generator().manual_seed(3)
    data, sampled = torch.rand(2, 4, 1, 3, 3, 3, generator=rng).double()
    made.contrast(data, made.convolution(data), sampled, 0.25, 0.5).backward()
    difference = 0
    for visible, sign in ((data, -1), (sampled, 1)):
        pieces = visible.unfold(2, 2, 1).unfold(3, 2, 1).unfold(4, 2, 1)
        together = torch.einsum("bcxyzijk,bfxyz->fcijk", pieces, made(visible).detach())
        difference = difference + sign * together / (4 * 8)
    torch.testing.assert_close(made.convolution.weight.grad, difference)
    torch.testing.assert_close(made.visible_bias.grad, (sampled - data).mean(0) / 2)
    active, imagined = (made(one).detach().mean((0, 2, 3, 4)) for one in (data, sampled))
    expected = imagined - active + 0.5 * (active - 0.25)
    torch.testing.assert_close(made.convolution.bias.grad, expected)


def test_filters_learn_nothing_where_there_is_nothing_under_them() -> None:
    made = machine()
    data = torch.zeros(1, 1, 3, 3, 3).double()
    data[..., 0, 0, 0] = 1  # Under one of the eight places.
    sampled = torch.full_like(data, 0.5)
    contrast = made.contrast(data, made.convolution(data), sampled, 0.0, 0.0)
    alone = contrast + (made.visible_bias * (data - sampled)).sum() / 2
    here, there = (
        conv3d(one[..., :2, :2, :2], made.convolution.weight, made.convolution.bias)
        for one in (data, sampled)
    )
    softplus = torch.nn.functional.softplus
    torch.testing.assert_close(alone, (softplus(there) - softplus(here)).sum())


def test_visible_units_start_with_the_odds_of_a_batch() -> None:
    made = machine()
    batch = torch.zeros(8, 1, 3, 3, 3)
    batch[:6, :, 1] = 1
    made.start_from(batch)
    started = torch.sigmoid(made.visible_bias)
    assert_allclose(started[:, 1].detach(), 0.7, rtol=1e-6)
    assert_allclose(started[:, [0, 2]].detach(), 0.1, rtol=1e-6)
    made.start_from(2 * batch[:6])
    below = 4 * 4  # Of the 8 voxels under every filter, the half, of 2 each.
    above = 2 * (2 * 2 / 3) ** 3  # Of 2 maps of 8 units that see 8 voxels, in mean over 27.
    assert made.scale == pytest.approx(below + above / 4)


def test_pretraining_lets_every_machine_reconstruct_better_than_the_mean(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(pretraining, "BATCH_SIZE", 8)
    torch.manual_seed(0)
    belief = BeliefNetwork(SIZE, ((6, 6, 2), (8, 5, 2)), (12,))
    with reproducible(torch.device("cpu"), threads=1):
        pretrain(belief, VIEWS, SIZE, Pretraining(1, 60, 20.0, 1), seed=0)
    visible = unpack(VIEWS.flatten(0, 1).permute(0, 3, 1, 2), SIZE)
    for depth, made in enumerate(belief.machines):
        data = belief.below(depth, visible)
        torch.manual_seed(1)
        error = (data - made.sample(made(data), 1)).square().mean()
        assert error < 0.8 * (data - data.mean(0)).square().mean()


def test_only_the_machine_in_training_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pretraining, "BATCH_SIZE", 4)
    torch.manual_seed(0)
    belief = BeliefNetwork(SIZE, ((4, 6, 2), (4, 5, 2)), ())
    states = []
    descend = pretraining._descend

    def watched(*arguments: object) -> None:
        descend(*arguments)
        states.append([made.convolution.weight.detach().clone() for made in belief.machines])

    monkeypatch.setattr(pretraining, "_descend", watched)
    with reproducible(torch.device("cpu"), threads=1):
        pretrain(belief, VIEWS, SIZE, Pretraining(0, 3, 20.0, 1), seed=0)
    moved = [
        [not torch.equal(*pair) for pair in zip(before, after, strict=True)]
        for before, after in pairwise(states)
    ]
    assert moved == [[True, False]] * 2 + [[False, True]] * 3


def test_the_network_is_as_published() -> None:
    belief = BeliefNetwork(
        30, tuple(zip((48, 160, 512), KERNELS, STRIDES, strict=True)), (1200, 4000)
    )
    assert [made.size for made in belief.machines] == [13, 5, 2, 1, 1]
    network = ShapeNetsNetwork(belief, 30, 40)
    assert sum(p.numel() for p in network.parameters()) == (
        48 * (6**3 + 1)
        + 160 * (48 * 5**3 + 1)
        + 512 * (160 * 4**3 + 1)
        + 1200 * (512 * 2**3 + 1)
        + 4000 * (1200 + 1)
        + 40 * (4000 + 1)
    )


def test_what_was_pretrained_is_what_the_classifier_starts_from() -> None:
    torch.manual_seed(0)
    belief = BeliefNetwork(SIZE, ((4, 6, 2), (8, 5, 2), (8, 4, 1)), (16, 12))
    images = VIEWS[:, 0].permute(0, 3, 1, 2)
    with torch.inference_mode():
        signatures = ShapeNetsNetwork(belief, SIZE, 3)(images)[1]
        torch.testing.assert_close(signatures, belief.below(5, unpack(images, SIZE)).flatten(1))


def test_a_network_learns_solids_and_shapes_of_a_class_are_near(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # As many as it takes whatever the processor's kernels round to: with 40, some learned nothing.
    monkeypatch.setattr(baseline_module, "MINIMUM_STEPS", (20, 240))
    monkeypatch.setattr(pretraining, "BATCH_SIZE", 8)
    found = SMALL.predict(SHAPES, TRAIN, TEST, device="cpu")
    assert [found.classes[k] for k in found.scores.argmax(axis=1)] == [i[0] for i in TEST]
    assert found.embeddings.shape == (len(TEST), 12)
    distances = found.pairwise_distances()
    assert distances[0, 1] < distances[0, 2:].min()


@pytest.mark.parametrize("module", [pretraining, training])
def test_a_killed_training_ends_as_an_undisturbed_one(
    module: object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whichever of the two it was killed in; what is finished is not repeated."""
    monkeypatch.setattr(baseline_module, "MINIMUM_STEPS", (3, 4))
    monkeypatch.setattr(pretraining, "BATCH_SIZE", 4)
    expected = SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu")
    for one in (pretraining, training):
        monkeypatch.setattr(one, "SECONDS_BETWEEN_CHECKPOINTS", 0.0)
    descend, steps = module._descend, []

    def killed(*arguments: object) -> None:
        if len(steps) == 2:
            raise KeyboardInterrupt
        steps.append(descend(*arguments))

    monkeypatch.setattr(module, "_descend", killed)
    checkpoint = tmp_path / "state.pt"
    with pytest.raises(KeyboardInterrupt):
        SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    monkeypatch.setattr(module, "_descend", lambda *a: steps.append(descend(*a)))
    found = SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    assert len(steps) == (5 * 3 if module is pretraining else 4)
    assert_array_equal(found.scores, expected.scores)
    assert_array_equal(found.embeddings, expected.embeddings)
    assert [path.name for path in tmp_path.iterdir()] == ["state.pt"]


def test_a_pretraining_that_diverges_names_its_own_rate(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(baseline_module, "MINIMUM_STEPS", (30, 4))
    wild = SMALL.model_copy(update={"pretraining_rate": 1e30})
    with pytest.raises(LearningError, match="lower pretraining_rate"):
        wild.predict(SHAPES, TRAIN, TEST, device="cpu")
