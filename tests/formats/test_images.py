"""A geometry image comes back from each format as exactly as the format can hold it."""

from __future__ import annotations

import io
import zlib
from pathlib import Path

import numpy as np
import pytest
import tifffile
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from gipkg.errors import ImageFormatError
from gipkg.formats.images import read_image, write_image
from gipkg.formats.png import decode_png, encode_png
from gipkg.formats.tiff import encode_tiff

RNG = np.random.default_rng(0)


def image(channels: int = 3, size: int = 7) -> np.ndarray:
    return np.random.default_rng(channels).normal(size=(channels, size, size)) * [[[1e-3]]]


@pytest.mark.parametrize("channels", [1, 2, 3, 5])
@pytest.mark.parametrize("size", [3, 5, 7])
def test_npy_is_exact_and_tiff_of_single_precision(
    tmp_path: Path, channels: int, size: int
) -> None:
    known = image(channels, size)
    for suffix in (".npy", ".tiff"):
        write_image(tmp_path / f"a{suffix}", known)
    np.testing.assert_array_equal(read_image(tmp_path / "a.npy"), known)
    np.testing.assert_array_equal(
        read_image(tmp_path / "a.tiff"), known.astype(np.float32).astype(np.float64)
    )


@pytest.mark.parametrize("channels", [1, 3])
def test_png_has_16_bits_of_the_range_of_each_channel(tmp_path: Path, channels: int) -> None:
    known = image(channels)
    write_image(tmp_path / "a.png", known)
    read = read_image(tmp_path / "a.png")
    half_a_level = np.ptp(known, axis=(1, 2)) / 65535 / 2
    assert (np.abs(read - known) <= 1.0001 * half_a_level[:, None, None]).all()
    levels, _ = decode_png((tmp_path / "a.png").read_bytes(), 7)
    assert levels.min(axis=(0, 1)).tolist() == [0] * channels
    assert levels.max(axis=(0, 1)).tolist() == [65535] * channels


def test_a_constant_channel_stays_constant(tmp_path: Path) -> None:
    known = np.full((3, 3, 3), 0.7)
    write_image(tmp_path / "a.png", known)
    np.testing.assert_array_equal(read_image(tmp_path / "a.png"), known)


@pytest.mark.parametrize(("dtype", "channels"), [(np.uint8, 1), (np.uint8, 3), (np.uint16, 1)])
def test_another_program_sees_the_same_pixels(dtype: type, channels: int) -> None:
    pixels = RNG.integers(0, np.iinfo(dtype).max, (5, 4, channels), endpoint=True).astype(dtype)
    content = encode_png(pixels, {"of": "a test"})
    seen = np.asarray(Image.open(io.BytesIO(content)))
    np.testing.assert_array_equal(seen.reshape(pixels.shape), pixels)


@pytest.mark.parametrize("channels", [1, 2, 3, 5])
def test_another_program_sees_the_same_numbers(channels: int) -> None:
    pixels = RNG.normal(size=(4, 4, channels)).astype(np.float32)
    seen = tifffile.imread(io.BytesIO(encode_tiff(pixels)))
    np.testing.assert_array_equal(seen.reshape(pixels.shape), pixels)


def test_the_facts_come_back_with_the_pixels() -> None:
    pixels = RNG.integers(0, 65536, (4, 6, 3)).astype(np.uint16)
    read, facts = decode_png(encode_png(pixels, {"low": [0.1]}), 10)
    assert facts == {"low": [0.1]}
    assert read.dtype == np.uint16
    np.testing.assert_array_equal(read, pixels)


def test_a_png_of_another_program_is_named(tmp_path: Path) -> None:
    Image.fromarray(RNG.integers(0, 255, (9, 9, 3)).astype(np.uint8)).save(tmp_path / "a.png")
    with pytest.raises(ImageFormatError, match=r"a\.png: not a geometry image"):
        read_image(tmp_path / "a.png")


def test_a_png_that_unpacks_to_more_than_it_is() -> None:
    whole = encode_png(np.zeros((4, 4, 1), np.uint8), {})
    larger = bytearray(whole)
    larger[16:24] = (16384).to_bytes(4) * 2
    larger[29:33] = zlib.crc32(larger[12:29]).to_bytes(4)
    with pytest.raises(ValueError, match="ends early"):
        decode_png(bytes(larger), 16384)


@settings(max_examples=80)
@given(st.data(), st.sampled_from([".npy", ".tiff", ".png"]))
def test_damage_is_named_or_leaves_numbers(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, suffix: str
) -> None:
    path = tmp_path_factory.mktemp("images") / f"a{suffix}"
    write_image(path, image())
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(0, len(content)))])
    try:
        read = read_image(path)
    except ImageFormatError:
        pass
    else:
        assert np.isfinite(read).all()
        assert read.shape[1] == read.shape[2]


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (np.zeros((3, 4, 5)), "geometry image is"),
        (np.zeros((4, 4)), "geometry image is"),
        (np.full((3, 4, 4), np.inf), "finite"),
        (np.zeros((3, 4, 4), dtype="U1"), "geometry image is"),
    ],
)
def test_what_is_no_image_is_named(tmp_path: Path, content: np.ndarray, fault: str) -> None:
    np.save(tmp_path / "a.npy", content)
    with pytest.raises(ImageFormatError, match=fault):
        read_image(tmp_path / "a.npy")


def test_channels_that_do_not_fit_are_refused_and_nothing_is_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="1 or 3 channels, not 2"):
        write_image(tmp_path / "a.png", image(2))
    with pytest.raises(ValueError, match="an image is written as"):
        write_image(tmp_path / "a.jpg", image())
    with pytest.raises(ImageFormatError, match="no such file"):
        read_image(tmp_path / "a.npy")
    assert list(tmp_path.iterdir()) == []
