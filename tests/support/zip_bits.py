"""A zip archive with every single fault of its directory, or of a header in it."""

from __future__ import annotations

from collections.abc import Iterator


def with_a_changed_bit(archive: bytes) -> Iterator[bytes]:
    """Yield the archive with one bit changed, for every bit after its members."""
    yield from _changed(archive, range(archive.index(b"PK\1\2"), len(archive)))


def with_a_changed_bit_of_a_header(archive: bytes) -> Iterator[bytes]:
    """Yield the archive with one bit changed, for every bit of the header of its first array."""
    begin = archive.index(b"\x93NUMPY")
    yield from _changed(archive, range(begin, archive.index(b"\n", begin) + 1))


def _changed(archive: bytes, places: range) -> Iterator[bytes]:
    for place in places:
        for bit in range(8):
            changed = bytes([archive[place] ^ 1 << bit])
            yield archive[:place] + changed + archive[place + 1 :]
