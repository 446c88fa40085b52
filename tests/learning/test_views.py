from __future__ import annotations

import numpy as np
import pytest
import torch

from gipkg.images import pad
from gipkg.learning.views import Layout, fit_scale, stack


def images(shapes: int = 5) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(0)
    units = np.array([1e-20, 1.0, 1e15])[:, None, None]
    return {
        f"s{i}": (units * rng.normal(3.0 + i, 2.0, size=(4, 3, 8, 8))).astype(np.float32)
        for i in range(shapes)
    }


def test_views_are_the_padded_images_with_channels_last() -> None:
    raw = images()
    views = stack(raw, ["s3", "s1"], Layout(margin=2))
    assert views.shape == (2, 4, 12, 12, 3)
    np.testing.assert_array_equal(views[0].permute(0, 3, 1, 2), pad(raw["s3"], 2))
    np.testing.assert_array_equal(views[1].permute(0, 3, 1, 2), pad(raw["s1"], 2))


def test_channels_of_any_scale_get_mean_0_and_deviation_1() -> None:
    views = stack(images(), ["s0", "s1", "s2"], Layout(margin=1))
    scaled = fit_scale(views, jointly=False)(views).double()
    np.testing.assert_allclose(scaled.mean((0, 1, 2, 3)), np.zeros(3), atol=1e-6)
    np.testing.assert_allclose(scaled.std((0, 1, 2, 3), correction=0), np.ones(3), rtol=1e-6)


def test_a_constant_channel_becomes_zero() -> None:
    views = torch.full((2, 3, 4, 4, 1), 7.0)
    assert (fit_scale(views, jointly=False)(views) == 0).all()


def test_jointly_scaled_channels_keep_their_proportions() -> None:
    units = np.array([1.0, 50.0], np.float32)[:, None, None]
    raw = {i: views[:, 1:2] * units for i, views in images().items()}
    views = stack(raw, ["s0", "s4"], Layout(margin=1))
    scaled = fit_scale(views, jointly=True)(views).double()
    assert scaled.mean().item() == pytest.approx(0, abs=1e-6)
    assert scaled.std(correction=0).item() == pytest.approx(1, rel=1e-6)
    first, second = scaled.std((0, 1, 2, 3))
    assert second / first == pytest.approx(50, rel=1e-4)


def test_a_shuffled_layout_keeps_the_values_and_moves_all_images_alike() -> None:
    raw = {"places": np.arange(2 * 3 * 64, dtype=np.float32).reshape(2, 3, 8, 8)}
    permutation = np.random.default_rng(0).permutation(64)
    views = stack(raw, ["places"], Layout(0, permutation))[0].flatten(1, 2)
    places = views[0, :, 0]
    assert (places != torch.arange(64)).sum() > 50
    for view in range(2):
        for channel in range(3):
            offset = float(raw["places"][view, channel, 0, 0])
            assert torch.equal(views[view, :, channel], places + offset)


def test_padding_a_mirrored_image_is_mirroring_a_padded_one() -> None:
    # The training mirrors padded views by transposing them.
    raw = images()["s0"]
    mirrored = {"s0": raw.swapaxes(-1, -2)}
    views = stack({"s0": raw}, ["s0"], Layout(margin=3))
    assert torch.equal(stack(mirrored, ["s0"], Layout(margin=3)), views.transpose(2, 3))
