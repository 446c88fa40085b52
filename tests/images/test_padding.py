"""Padding continues the surface over the cut."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.images.octahedron import pixel_directions
from gipkg.images.padding import pad


def directions_image(size: int) -> np.ndarray:
    return np.moveaxis(pixel_directions(size), -1, 0)


@pytest.mark.parametrize("size", [5, 8, 56])
@pytest.mark.parametrize("margin", [0, 1, 4])
def test_beyond_a_side_lies_the_mirror_image_in_the_plane_of_the_cut(size, margin) -> None:
    """The cut lies in the planes x = 0 and y = 0, and the octants on both sides mirror."""
    image = directions_image(size)
    padded = pad(image, margin)
    assert padded.shape == (3, size + 2 * margin, size + 2 * margin)
    inner = slice(margin, margin + size)
    assert_array_equal(padded[:, inner, inner], image)
    over_x, over_y = np.array([[-1, 1, 1], [1, -1, 1]])[:, :, None]
    for k in range(1, margin + 1):
        assert_array_equal(padded[:, inner, margin - k], image[:, :, k] * over_y)
        assert_array_equal(padded[:, inner, margin + size - 1 + k], image[:, :, -1 - k] * over_y)
        assert_array_equal(padded[:, margin - k, inner], image[:, k] * over_x)
        assert_array_equal(padded[:, margin + size - 1 + k, inner], image[:, -1 - k] * over_x)
        for m in range(1, margin + 1):
            around_pole = image[:, k, m] * over_x[:, 0] * over_y[:, 0]
            assert_array_equal(padded[:, margin - k, margin - m], around_pole)


def test_linear_functions_bend_on_the_cut_as_on_an_edge_that_is_not_cut() -> None:
    """The octahedron's northern edges, inside the image, are its southern ones mirrored."""
    size, middle = 57, 28
    image = directions_image(size)
    bend_down = np.linalg.norm(np.diff(image, n=2, axis=1), axis=0)
    on_northern_edge = bend_down[middle - 1, middle + 1 :]
    bend_across = np.linalg.norm(np.diff(pad(image, 1), n=2, axis=2), axis=0)
    on_cut = bend_across[1 : middle + 1, -1]  # from the south pole to the middle of a side
    assert_allclose(on_cut[1:], on_northern_edge[:-1], atol=1e-14)
    assert_allclose(bend_across[1:-1, 0], bend_across[1:-1, -1], atol=1e-14)
    reflected = np.pad(image, ((0, 0), (1, 1), (1, 1)), mode="reflect")
    without_turn = np.linalg.norm(np.diff(reflected, n=2, axis=2), axis=0)[2 : middle + 1, -1]
    assert (without_turn > 1.9 * on_cut[1:]).any()


def test_a_smooth_function_goes_on_without_a_jump() -> None:
    x, y, z = directions_image(56)
    image = np.sin(3 * x + 1) * np.cos(2 * y - z) + x * y * z
    padded = pad(image, 8)
    for axis in (0, 1):
        step = np.moveaxis(np.abs(np.diff(padded, axis=axis)), axis, 0)
        inside = np.abs(np.diff(image, axis=axis)).max()
        assert max(step[7:9].max(), step[-9:-7].max()) <= 1.01 * inside


def test_padding_by_parts_is_padding_at_once() -> None:
    image = np.random.default_rng(0).standard_normal((2, 3, 9, 9))
    image = image + image[..., ::-1, ::-1]
    once = pad(image, 6)
    assert_array_equal(pad(image, 2), once[..., 4:-4, 4:-4])
    assert_array_equal(np.rot90(once, 2, (-2, -1)), once)


def test_replicas_are_turned_by_half_a_turn() -> None:
    """The paper's rule itself: beyond a side the image turned by 180°, its side shared."""
    image = np.random.default_rng(1).standard_normal((7, 7))
    padded = pad(image, 6)
    turned = np.rot90(image, 2)
    assert_array_equal(padded[6:13, 13:], turned[:, 1:])
    assert_array_equal(padded[6:13, :6], turned[:, :-1])
    assert_array_equal(padded[13:, 6:13], turned[1:])
    assert_array_equal(padded[:6, 6:13], turned[:-1])
    assert_array_equal(padded[13:, 13:], image[1:, 1:])


def test_torch_tensors_are_padded_as_arrays_are() -> None:
    torch = pytest.importorskip("torch")
    images = np.random.default_rng(2).standard_normal((2, 3, 56, 56)).astype(np.float32)
    padded = pad(torch.from_numpy(images), 4)
    assert isinstance(padded, torch.Tensor)
    assert_array_equal(padded.numpy(), pad(images, 4))


@pytest.mark.parametrize("margin", [-1, 7])
def test_a_margin_beyond_the_image_is_refused(margin: int) -> None:
    with pytest.raises(ValueError, match="must be 0 to 6 for 7 pixels"):
        pad(np.zeros((7, 7)), margin)
