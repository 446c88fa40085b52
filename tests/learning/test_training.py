from __future__ import annotations

from itertools import islice

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from gipkg.learning.config import TrainingConfig
from gipkg.learning.network import ViewClassifier
from gipkg.learning.training import (
    batches,
    drawn_views,
    learning_rate,
    number_of_steps,
    train,
)


def test_every_epoch_shows_every_sample_once_in_another_order() -> None:
    samples, size = 30, 8
    shown = np.concatenate(list(islice(batches(samples, size, seed=1, start=0), 15)))
    epochs = shown.reshape(4, samples)
    np.testing.assert_array_equal(np.sort(epochs, axis=1), np.tile(np.arange(samples), (4, 1)))
    assert len({tuple(epoch) for epoch in epochs}) == 4


@pytest.mark.parametrize(("samples", "start"), [(30, 7), (5, 3), (1, 2)])
def test_a_later_start_continues_the_same_order(samples: int, start: int) -> None:
    whole = list(islice(batches(samples, 8, seed=1, start=0), start + 5))
    later = list(islice(batches(samples, 8, seed=1, start=start), 5))
    np.testing.assert_array_equal(later, whole[start:])


def test_the_order_depends_on_the_seed() -> None:
    first, second = (next(batches(100, 64, seed, start=0)) for seed in (0, 1))
    assert (first != second).any()


def test_a_sample_of_several_views_is_of_one_shape() -> None:
    samples = np.arange(10)  # of five shapes with nine views each, two samples a shape
    shown = drawn_views(samples, views=9, together=4, rng=np.random.default_rng(0))
    np.testing.assert_array_equal(shown // 9, np.tile(samples[:, None] // 2, 4))
    assert all(len(set(views)) == 4 for views in shown)
    assert len({tuple(views % 9) for views in shown}) == 10
    alone = drawn_views(samples, views=9, together=1, rng=np.random.default_rng(0))
    np.testing.assert_array_equal(alone, samples[:, None])


def test_training_lasts_whole_epochs_but_not_too_few_steps() -> None:
    config = TrainingConfig(epochs=3, batch_size=10, minimum_steps=20)
    assert number_of_steps(config, views=101) == 31
    assert number_of_steps(config, views=10) == 20


def test_the_one_cycle_rises_and_falls_to_zero() -> None:
    config = TrainingConfig(learning_rate=0.5)
    rates = [learning_rate(config, done) for done in np.linspace(0, 1, 1001)]
    top = int(np.argmax(rates))
    assert rates[0] == 0
    assert max(rates) == pytest.approx(0.5)
    assert (np.diff(rates[: top + 1]) > 0).all()
    assert (np.diff(rates[top:]) < 0).all()
    assert rates[-1] == pytest.approx(0, abs=1e-9)


def test_the_rate_falls_three_times_tenfold_in_steps() -> None:
    config = TrainingConfig(schedule="steps", learning_rate=1e-2)
    rates = [learning_rate(config, done) for done in (0, 0.24, 0.26, 0.51, 0.76, 0.99)]
    np.testing.assert_allclose(rates, [1e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-5])


class Witness(ViewClassifier):
    """Judges a sample by the mean of its pixels and keeps what it is shown."""

    def __init__(self, together: int) -> None:
        super().__init__()
        self.together, self.shown = together, list[Tensor]()
        self.classifier = nn.Linear(1, 2)

    def forward(self, views: Tensor) -> tuple[Tensor, Tensor]:
        self.shown.append(views.unflatten(0, (-1, self.together)).squeeze(2))
        means = self.shown[-1].mean(dim=(1, 2, 3))[:, None]
        return self.classifier(means), means


@pytest.mark.parametrize("together", [1, 3])
def test_every_other_sample_is_mirrored_with_all_of_its_views(together: int) -> None:
    # The pixel below the corner tells a view from its mirror image.
    views = torch.rand(8, 6, 4, 4, 1) * 0.5
    views[:, :, 1, 0], views[:, :, 0, 1] = 1, 0
    network = Witness(together)
    config = TrainingConfig(epochs=1, batch_size=4 * together, minimum_steps=1, mirror=True)
    train(network, views, torch.arange(8) % 2, config, seed=0)
    known = {view.numpy().tobytes() for view in views.squeeze(-1).flatten(0, 1)}
    assert len(network.shown) == 48 // (4 * together)
    for samples in network.shown:
        mirrored = samples[:, :, 0, 1] == 1
        assert (mirrored == torch.tensor([[True], [False], [True], [False]])).all()
        upright = torch.where(mirrored[..., None, None], samples.transpose(-2, -1), samples)
        assert {view.numpy().tobytes() for view in upright.flatten(0, 1)} <= known
