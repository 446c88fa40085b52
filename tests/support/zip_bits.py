"""A zip archive with every single fault of its directory."""

from __future__ import annotations

from collections.abc import Iterator


def with_a_changed_bit(archive: bytes) -> Iterator[bytes]:
    """Yield the archive with one bit changed, for every bit after its members."""
    for place in range(archive.index(b"PK\1\2"), len(archive)):
        for bit in range(8):
            changed = bytes([archive[place] ^ 1 << bit])
            yield archive[:place] + changed + archive[place + 1 :]
