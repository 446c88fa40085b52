"""How far a loop is: a bar in a terminal, a line now and then in a log."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator, Sequence
from typing import TypeVar

Item = TypeVar("Item")

SECONDS_BETWEEN_LINES = 5.0


def progress(items: Sequence[Item], label: str, done: int = 0) -> Iterator[Item]:
    """Yield the items and report to standard error how many have been dealt with.

    Parameters
    ----------
    items : sequence
        What is left to do.
    label : str
        What is done.
    done : int
        How many items an earlier run has dealt with; they count, but are not repeated.
    """
    if sys.stderr.isatty():
        from tqdm import tqdm

        return iter(tqdm(items, label, total=done + len(items), initial=done))
    return _lines(items, label, done)


def _lines(items: Sequence[Item], label: str, done: int) -> Iterator[Item]:
    total = done + len(items)
    began = last = time.monotonic()
    for count, item in enumerate(items, start=done + 1):
        yield item
        now = time.monotonic()
        if count == total or now - last >= SECONDS_BETWEEN_LINES:
            last = now
            sys.stderr.write(f"{label}: {count}/{total} after {now - began:.1f} s\n")
            sys.stderr.flush()
