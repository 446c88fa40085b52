"""The lines of a text, one at a time: a list of them would take far more memory than the text."""

from __future__ import annotations

import io
from collections.abc import Iterator


def words_of_lines(text: bytes) -> Iterator[list[bytes]]:
    """Split each line that is not empty into words; ``#`` begins a comment."""
    if b"\r" in text:
        text = text.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    for line in io.BytesIO(text):
        if words := line.partition(b"#")[0].split():
            yield words
