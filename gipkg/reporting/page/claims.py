"""Whether the figures show what those of the paper show."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from statistics import fmean

from gipkg.files import read_csv
from gipkg.reporting.page.reference import Claim

_TAKE: Mapping[str, Callable[[Sequence[float]], float]] = {
    "min": min,
    "max": max,
    "mean": fmean,
    "first": lambda values: values[0],
    "last": lambda values: values[-1],
}


@dataclass(frozen=True, slots=True)
class Checked:
    """A claim and the number that decides on it.

    Attributes
    ----------
    says : str
    condition : str
        Such as ``≥ 0.9``.
    value : float or None
        None where this run has no such number.
    """

    says: str
    condition: str
    value: float | None
    holds: bool


def check(claim: Claim, results: Path) -> Checked:
    """Hold a claim against the numbers of a run.

    Parameters
    ----------
    claim : Claim
    results : Path
        Folder of the results.

    Raises
    ------
    KeyError
        The table has no such column, or the claim takes what is not known.
    """
    path = results / claim.table
    rows = read_csv(path) if path.is_file() else []
    chosen = [
        float(row[claim.column])
        for row in rows
        if all(fnmatchcase(row[name], pattern) for name, pattern in claim.where.items())
        and row[claim.column]
    ]
    value = _TAKE[claim.take](chosen) if chosen else None
    low, high = claim.at_least, claim.at_most
    bounds = [f"≥ {low:g}"] if low is not None else []
    bounds += [f"≤ {high:g}"] if high is not None else []
    holds = value is not None and (low is None or value >= low) and (high is None or value <= high)
    return Checked(claim.says, " and ".join(bounds), value, holds)
