"""PNG files of 8 and 16 bits with facts in them; the usual libraries have no colour in 16 bits.

Format: W3C, Portable Network Graphics (PNG) Specification, Third Edition. Of its row filters,
``Up`` alone is written and read: a sum down the rows, done for all pixels at once.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_UP = 2
_COLOUR_TYPES = {1: 0, 3: 2}
_KEYWORD = b"gipkg"
_HEADER = struct.Struct(">IIBBBBB")
_SMALLEST_RATIO = 1100
"""Deflate makes no more than 1032 bytes of one."""


def encode_png(pixels: NDArray[np.uint8] | NDArray[np.uint16], facts: Mapping[str, Any]) -> bytes:
    """Return the PNG file of a picture; the same picture, the same bytes.

    Parameters
    ----------
    pixels : (H, W, C) uint8 or uint16 array
        One channel is grey, three are red, green and blue.
    facts : mapping
        What else to say, as JSON; nothing where it is empty.
    """
    height, width, channels = pixels.shape
    depth = 8 * pixels.dtype.itemsize
    rows = np.frombuffer(pixels.astype(f">u{depth // 8}").tobytes(), np.uint8).reshape(height, -1)
    filtered = np.full((height, rows.shape[1] + 1), _UP, np.uint8)
    filtered[:, 1:] = np.diff(rows, axis=0, prepend=np.zeros_like(rows[:1]))  # modulo 256
    size = _HEADER.pack(width, height, depth, _COLOUR_TYPES[channels], 0, 0, 0)
    text = _KEYWORD + b"\0" + json.dumps(facts, sort_keys=True).encode("latin-1")
    return b"".join(
        (
            _SIGNATURE,
            _chunk(b"IHDR", size),
            _chunk(b"tEXt", text) if facts else b"",
            _chunk(b"IDAT", zlib.compress(filtered.tobytes(), 6)),
            _chunk(b"IEND", b""),
        )
    )


def decode_png(
    content: bytes, maximum_side: int
) -> tuple[NDArray[np.uint8] | NDArray[np.uint16], dict[str, Any]]:
    """Read what :func:`encode_png` made.

    Returns
    -------
    pixels : (H, W, C) uint8 or uint16 array
    facts : dict

    Raises
    ------
    ValueError
        It is no PNG, is damaged, or was written by another program.
    """
    chunks = _chunks(content)
    width, height, depth, colour, *ways = _HEADER.unpack(chunks.get(b"IHDR", b"").ljust(13, b"\0"))
    channels = {number: count for count, number in _COLOUR_TYPES.items()}.get(colour)
    if depth not in (8, 16) or channels is None or any(ways):
        raise ValueError("this kind of PNG is not written by gipkg")
    if not (0 < width <= maximum_side and 0 < height <= maximum_side):
        raise ValueError(f"{width} x {height} pixels are not 1 to {maximum_side} a side")
    stride = 1 + width * channels * depth // 8
    packed = chunks.get(b"IDAT", b"")
    if stride * height > _SMALLEST_RATIO * len(packed):
        raise ValueError("it ends early")
    try:
        filtered = zlib.decompressobj().decompress(packed, stride * height)
    except zlib.error as error:
        raise ValueError(f"its pixels cannot be unpacked: {error}") from error
    if len(filtered) != stride * height:
        raise ValueError("it ends early")
    rows = np.frombuffer(filtered, np.uint8).reshape(height, stride)
    if (rows[:, 0] != _UP).any():
        raise ValueError("another program wrote it; its values are no longer exact")
    values = np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8)
    pixels = np.frombuffer(values.tobytes(), f">u{depth // 8}").reshape(height, width, channels)
    return pixels.astype(f"u{depth // 8}"), _facts(chunks.get(b"tEXt", b""))


def _chunk(kind: bytes, content: bytes) -> bytes:
    checksum = zlib.crc32(kind + content)
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)


def _chunks(content: bytes) -> dict[bytes, bytes]:
    """Split a file into the content of its chunks, by kind."""
    if not content.startswith(_SIGNATURE):
        raise ValueError("it is no PNG")
    chunks: dict[bytes, bytes] = {}
    at = len(_SIGNATURE)
    while at + 12 <= len(content):
        length = int.from_bytes(content[at : at + 4])
        kind, body = content[at + 4 : at + 8], content[at + 8 : at + 8 + length]
        checksum = content[at + 8 + length : at + 12 + length]
        if zlib.crc32(kind + body) != int.from_bytes(checksum):
            raise ValueError(f"its part {kind!r} is damaged")
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    return chunks


def _facts(text: bytes) -> dict[str, Any]:
    keyword, _, content = text.partition(b"\0")
    try:
        facts = json.loads(content) if keyword == _KEYWORD else {}
    except RecursionError as error:
        raise ValueError("what it says of itself is not readable") from error
    return facts if isinstance(facts, dict) else {}
