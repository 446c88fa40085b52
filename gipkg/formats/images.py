"""Geometry images as files: exact, for image programs, or for the eye."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import ImageFormatError
from gipkg.files import atomic
from gipkg.formats import IMAGE_SUFFIXES
from gipkg.formats.arrays import read_array
from gipkg.formats.png import decode_png, encode_png
from gipkg.formats.tiff import decode_tiff, encode_tiff

MAXIMUM_SIDE = 16384
"""Pixels along a side of an image that is read."""

_LEVELS = 65535


def write_image(path: Path, image: NDArray[np.floating]) -> None:
    """Write a geometry image in the format that the suffix names, atomically.

    Parameters
    ----------
    path : Path
        Ends in one of `IMAGE_SUFFIXES`.
    image : (C, n, n) array

    Raises
    ------
    ValueError
        The suffix is none of them, or the format does not hold C channels.
    """
    image = np.asarray(image)
    suffix = path.suffix.lower()
    if suffix not in IMAGE_SUFFIXES:
        raise ValueError(f"{path}: an image is written as {', '.join(IMAGE_SUFFIXES)}")
    if suffix == ".png" and len(image) not in (1, 3):
        raise ValueError(f"a PNG holds 1 or 3 channels, not {len(image)}; write .npy or .tiff")
    with atomic(path) as stream:
        if suffix == ".npy":
            np.save(stream, image, allow_pickle=False)
        elif suffix == ".tiff":
            stream.write(encode_tiff(np.moveaxis(image, 0, -1)))
        else:
            stream.write(_to_png(image))


def read_image(path: Path) -> NDArray[np.float64]:
    """Read a geometry image.

    Parameters
    ----------
    path : Path
        As :func:`write_image` writes it, or any ``.npy`` of (C, n, n) numbers.

    Returns
    -------
    (C, n, n) float64 array

    Raises
    ------
    ImageFormatError
        There is no such file, or it is no square image of finite numbers.
    """
    if not path.is_file():
        raise ImageFormatError(f"{path}: there is no such file")
    readers = {".npy": read_array, ".tiff": _from_tiff, ".png": _from_png}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise ImageFormatError(f"{path}: the suffix is none of {', '.join(readers)}")
    try:
        image = reader(path)
    except (ValueError, EOFError) as error:
        raise ImageFormatError(f"{path}: not a geometry image ({error})") from error
    if image.dtype.kind not in "fiu" or image.ndim != 3 or image.shape[1] != image.shape[2]:
        raise ImageFormatError(
            f"{path}: a geometry image is (C, n, n) numbers, not {image.shape} of {image.dtype}"
        )
    if not np.isfinite(image).all():
        raise ImageFormatError(f"{path}: not all pixels are finite")
    return image.astype(np.float64)


def _to_png(image: NDArray[np.floating]) -> bytes:
    pixels = np.moveaxis(image, 0, -1).astype(np.float64)
    low, high = pixels.min(axis=(0, 1)), pixels.max(axis=(0, 1))
    spread = np.where(high > low, high - low, 1.0)
    levels = np.rint((pixels - low) / spread * _LEVELS).astype(np.uint16)
    return encode_png(levels, {"low": low.tolist(), "high": high.tolist()})


def _from_png(path: Path) -> NDArray[np.float64]:
    levels, facts = decode_png(path.read_bytes(), MAXIMUM_SIDE)
    try:
        low, high = (np.array(facts[name], dtype=np.float64) for name in ("low", "high"))
    except (KeyError, TypeError) as error:
        raise ValueError("the range of its values is not in it: it is some picture") from error
    if levels.dtype != np.uint16 or low.shape != high.shape or low.shape != levels.shape[2:]:
        raise ValueError("the range of its values does not fit its pixels")
    return np.moveaxis(low + levels / _LEVELS * (high - low), -1, 0)


def _from_tiff(path: Path) -> NDArray[np.float32]:
    return np.moveaxis(decode_tiff(path.read_bytes()), -1, 0)
