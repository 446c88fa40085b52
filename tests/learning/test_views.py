from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
import torch

from gipkg.images.padding import pad
from gipkg.learning.views import Layout, Scale, fit_scale, stack, views_of

AS_IT_IS = Scale(torch.zeros(1), torch.ones(1))


def images(shapes: int = 5) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(0)
    units = np.array([1e-20, 1.0, 1e15])[:, None, None]
    return {
        f"s{i}": (units * rng.normal(3.0 + i, 2.0, size=(4, 3, 8, 8))).astype(np.float32)
        for i in range(shapes)
    }


def scaled(raw: dict[str, np.ndarray], jointly: bool) -> torch.Tensor:
    layout, ids = Layout(margin=1), list(raw)
    scale = fit_scale(raw, ids, layout, jointly)
    return torch.stack([views_of(raw[i], layout, scale) for i in ids]).double()


def test_views_are_the_padded_images_with_channels_last() -> None:
    raw = images()
    views = views_of(raw["s3"], Layout(margin=2), AS_IT_IS)
    assert (views.shape, views.dtype) == ((4, 12, 12, 3), torch.float32)
    np.testing.assert_array_equal(views.permute(0, 3, 1, 2), pad(raw["s3"], 2))


@pytest.mark.parametrize("precision", [torch.float16, torch.bfloat16])
def test_the_views_of_a_training_part_are_scaled_in_half_precision(precision: torch.dtype) -> None:
    raw, ids, layout = images(), ["s3", "s1"], Layout(margin=2)
    scale = fit_scale(raw, ids, layout, jointly=False)
    views = stack(raw, ids, layout, scale, precision)
    assert (views.shape, views.dtype) == ((2, 4, 12, 12, 3), precision)
    for found, shape_id in zip(views, ids, strict=True):
        assert torch.equal(found, views_of(raw[shape_id], layout, scale).to(precision))


def test_channels_of_any_scale_get_mean_0_and_deviation_1() -> None:
    """Over what is seen: the padding shows some pixels more often than others."""
    views = scaled(images(3), jointly=False)
    np.testing.assert_allclose(views.mean((0, 1, 2, 3)), np.zeros(3), atol=1e-6)
    np.testing.assert_allclose(views.std((0, 1, 2, 3), correction=0), np.ones(3), rtol=1e-6)


@pytest.mark.parametrize("value", [7.0, 0.1, 1e20])
def test_a_constant_channel_becomes_zero(value: float) -> None:
    raw = {shape: np.full((3, 1, 9, 9), value, np.float32) for shape in ("a", "b", "c")}
    assert (scaled(raw, jointly=False) == 0).all()


def test_jointly_scaled_channels_keep_their_proportions() -> None:
    units = np.array([1.0, 50.0], np.float32)[:, None, None]
    views = scaled({i: shown[:, 1:2] * units for i, shown in images(2).items()}, jointly=True)
    assert views.mean().item() == pytest.approx(0, abs=1e-6)
    assert views.std(correction=0).item() == pytest.approx(1, rel=1e-6)
    first, second = views.std((0, 1, 2, 3))
    assert second / first == pytest.approx(50, rel=1e-4)


def test_a_shuffled_layout_keeps_the_values_and_moves_all_images_alike() -> None:
    raw = {"places": np.arange(2 * 3 * 64, dtype=np.float32).reshape(2, 3, 8, 8)}
    permutation = np.random.default_rng(0).permutation(64)
    views = views_of(raw["places"], Layout(0, permutation), AS_IT_IS).flatten(1, 2)
    places = views[0, :, 0]
    assert (places != torch.arange(64)).sum() > 50
    for view in range(2):
        for channel in range(3):
            offset = float(raw["places"][view, channel, 0, 0])
            assert torch.equal(views[view, :, channel], places + offset)


def test_padding_a_mirrored_image_is_mirroring_a_padded_one() -> None:
    # The training mirrors padded views by transposing them.
    raw = images()["s0"]
    layout = Layout(margin=3)
    mirrored = views_of(raw, layout, AS_IT_IS).transpose(1, 2)
    assert torch.equal(views_of(raw.swapaxes(-1, -2), layout, AS_IT_IS), mirrored)


def test_a_training_does_not_wait_for_imports_of_meshes_and_compilers() -> None:
    code = "import sys, gipkg.learning.model; print({'trimesh', 'numba'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
