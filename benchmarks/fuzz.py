"""Damaged mesh files through the readers and the surface stage: what was tried, what came out.

    python -m benchmarks.fuzz --seconds 600 --seed 0

Every input is a small file of some format to which up to five things have happened: bytes flipped,
cut out, doubled, numbers replaced by wild ones, two files spliced. It has to end in a closed
surface of genus 0 or in an error of gipkg's, within --limit seconds and --gigabytes of memory.
Whatever else comes out is kept in --keep, and the exit status is how many that were. The inputs are
numbered, and those of one seed are always the same.
"""

from __future__ import annotations

import argparse
import itertools
import multiprocessing
import resource
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random

import gipkg
from gipkg.errors import GipkgError
from tests.support.mutations import damaged, whole_files
from tests.surfaces.solids import assert_genus_zero

FORK = multiprocessing.get_context("fork")
NAMED = {"none", "repair", "volume", "MeshFormatError", "UnsupportedMesh"}


def main() -> int:
    """Print how many inputs of each format came to each end."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--limit", type=float, default=60, help="seconds for one input")
    parser.add_argument("--gigabytes", type=float, default=4)
    parser.add_argument("--keep", type=Path, default=Path("fuzz-failures"))
    options = parser.parse_args()
    whole_files()
    ends: Counter[tuple[str, str]] = Counter()
    slowest, peak, failures = 0.0, 0, 0
    number = options.first
    deadline = time.monotonic() + options.seconds
    while time.monotonic() < deadline:
        for suffix, end, seconds, memory in ends_of(number, options):
            if end not in NAMED:
                failures += 1
                keep(options, number, end)
            ends[suffix, end if end in NAMED else "NEITHER"] += 1
            slowest, peak = max(slowest, seconds), max(peak, memory)
            number += 1
            if time.monotonic() > deadline:
                break
    for (suffix, end), count in sorted(ends.items()):
        print(f"{suffix:4} {end:20} {count:8}")
    tried = number - options.first
    print(f"{tried} inputs, {failures} of them neither; slowest {slowest:.1f} s, peak {peak} MB")
    return min(failures, 100)


def ends_of(first: int, options: argparse.Namespace) -> Iterator[tuple[str, str, float, int]]:
    """Yield what becomes of the inputs from one number on, until one ends its process."""
    receiver, sender = FORK.Pipe(duplex=False)
    process = FORK.Process(target=work, args=(sender, first, options))
    process.start()
    sender.close()
    number = first
    try:
        while True:
            if not receiver.poll(options.limit):
                yield damaged_file(options.seed, number)[0], "takes too long", options.limit, 0
                return
            yield receiver.recv()
            number += 1
    except EOFError:
        process.join()
        yield damaged_file(options.seed, number)[0], f"ended with {process.exitcode}", 0.0, 0
    finally:
        process.kill()
        process.join()


def work(sender: Connection, first: int, options: argparse.Namespace) -> None:
    """Send what becomes of one input after the other."""
    most = int(options.gigabytes * 2**30)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    for number in itertools.count(first):
        suffix, content = damaged_file(options.seed, number)
        began = time.process_time()
        try:
            end = outcome(suffix, content)
        except Exception as error:
            end = f"{type(error).__name__}: {error}"
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
        sender.send((suffix, end, time.process_time() - began, peak))


def damaged_file(seed: int, number: int) -> tuple[str, bytes]:
    """Return the suffix and the content of one input."""
    return damaged(Random(f"{seed} {number}"))


def keep(options: argparse.Namespace, number: int, end: str) -> None:
    """Write an input that came to no good end, and say so."""
    suffix, content = damaged_file(options.seed, number)
    options.keep.mkdir(exist_ok=True)
    path = options.keep / f"{options.seed}-{number}.{suffix}"
    path.write_bytes(content)
    print(f"{path}: {end}", flush=True)


def outcome(suffix: str, content: bytes) -> str:
    """Prepare one file; return how its surface came about, or the name of the error."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"damaged.{suffix}"
        path.write_bytes(content)
        try:
            surface = gipkg.prepare(path, resolution=12, vertices=40)
        except GipkgError as error:
            return type(error).__name__
    assert_genus_zero(surface.mesh)
    return surface.report.method


if __name__ == "__main__":
    sys.exit(main())
