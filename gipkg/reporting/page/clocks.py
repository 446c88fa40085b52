"""What a run took, from the clocks that the workflow keeps beside its results."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Clock:
    """Jobs and what they took.

    Attributes
    ----------
    stage : str
        A folder of the results, or a table or figure.
    jobs : int
    seconds : float
        By the wall, of all jobs together.
    """

    stage: str
    jobs: int
    seconds: float


def read_clocks(benchmarks: Path) -> list[Clock]:
    """Sum up the benchmark files of the workflow by stage."""
    taken: dict[str, list[float]] = {}
    for path in sorted(benchmarks.rglob("*.tsv")):
        stage = path.relative_to(benchmarks).parts[0].removesuffix(".tsv")
        taken.setdefault(stage, []).extend(_seconds(path))
    return [Clock(stage, len(seconds), sum(seconds)) for stage, seconds in taken.items()]


def seconds_of(databases: Iterable[str], benchmarks: Path) -> float:
    """Sum up what all stages took for some databases."""
    chosen = set(databases)
    return sum(
        second
        for path in benchmarks.rglob("*.tsv")
        if chosen & set(path.relative_to(benchmarks).with_suffix("").parts[1:])
        for second in _seconds(path)
    )


def _seconds(path: Path) -> list[float]:
    with path.open(encoding="utf-8", newline="") as stream:
        return [float(row["s"]) for row in csv.DictReader(stream, delimiter="\t")]
