"""TIFF files of 32-bit floating point numbers, as image programs open them.

Format: Adobe, TIFF Revision 6.0, sections 2 and 19. One layout is written, a function of the
image's size, and no other is read: a header cannot ask for more than the file holds.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

_SHORT, _LONG = 3, 4
_FIRST = 8
"""Where the directory begins."""
_WIDTH_AT, _CHANNELS_AT = 18, 90
"""Where the values of two of its entries are."""


def encode_tiff(pixels: NDArray[np.floating]) -> bytes:
    """Return the file of an image (H, W, C) in single precision; the same image, the same bytes."""
    height, width, channels = pixels.shape
    return _header(height, width, channels) + pixels.astype("<f4").tobytes()


def decode_tiff(content: bytes) -> NDArray[np.float32]:
    """Read a square image (n, n, C) that :func:`encode_tiff` made.

    Raises
    ------
    ValueError
        Another program wrote it, or it is damaged.
    """
    if len(content) < _CHANNELS_AT + 4:
        raise ValueError("it ends early")
    side, channels = (
        int.from_bytes(content[k : k + 4], "little") for k in (_WIDTH_AT, _CHANNELS_AT)
    )
    header = b""
    if 0 < 4 * side * side * channels < len(content):
        header = _header(side, side, channels)
    if not header or content[: len(header)] != header:
        raise ValueError("not a TIFF as gipkg writes it: square, uncompressed, 32-bit numbers")
    if len(content) != len(header) + 4 * side * side * channels:
        raise ValueError("it is longer or shorter than its header says")
    return np.frombuffer(content[len(header) :], "<f4").reshape(side, side, channels)


def _header(height: int, width: int, channels: int) -> bytes:
    """Return everything before the pixels: the directory, and lists too long for its entries."""
    colours = 3 if channels == 3 else 1
    extra = channels - colours
    entries: list[tuple[int, int, list[int]]] = [
        (256, _LONG, [width]),
        (257, _LONG, [height]),
        (258, _SHORT, [32] * channels),
        (259, _SHORT, [1]),  # not compressed
        (262, _SHORT, [2 if colours == 3 else 1]),  # red, green and blue; or grey
        (277, _LONG, [channels]),
        (278, _LONG, [height]),
        (279, _LONG, [4 * height * width * channels]),
        (273, _LONG, [0]),  # where the pixels begin, known at the end
        *([(338, _SHORT, [0] * extra)] if extra else []),  # of no meaning to others
        (339, _SHORT, [3] * channels),  # floating point
    ]
    entries.sort()
    end = _FIRST + 2 + 12 * len(entries) + 4
    pixels = end + sum(2 * len(values) for _, _, values in entries if len(values) > 2)
    directory, lists = struct.pack("<H", len(entries)), b""
    for tag, kind, values in entries:
        packed = struct.pack(f"<{len(values)}{'H' if kind == _SHORT else 'I'}", *values)
        if tag == 273:
            packed = struct.pack("<I", pixels)
        elif len(packed) > 4:
            packed, lists = struct.pack("<I", end + len(lists)), lists + packed
        directory += struct.pack("<HHI", tag, kind, len(values)) + packed.ljust(4, b"\0")
    return struct.pack("<2sHI", b"II", 42, _FIRST) + directory + struct.pack("<I", 0) + lists
