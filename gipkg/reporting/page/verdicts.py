"""What a figure of ours says of the paper's own: computed, never written down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fnmatch import fnmatchcase


class Verdict(StrEnum):
    """How a figure of ours stands to the paper's."""

    MATCHES = "matches"
    BETTER = "better"
    DIFFERS = "differs"
    NOT_IN_THIS_RUN = "not in this run"
    NOT_ATTEMPTED = "not attempted"
    NOT_IN_THE_PAPER = "not in the paper"


@dataclass(frozen=True, slots=True)
class Scale:
    """How far two values of a quantity may be apart and be the same.

    Attributes
    ----------
    tolerance : float
        In the quantity's units; a share of the paper's value if `relative`.
    relative : bool
    lower_is_better : bool
    """

    tolerance: float
    relative: bool = False
    lower_is_better: bool = False


def judge(ours: float | None, printed: float | None, spread: float, scale: Scale) -> Verdict:
    """Set a value against the one that the paper prints.

    Parameters
    ----------
    ours : float or None
        None where this run has no such value.
    printed : float or None
        None where the paper has none.
    spread : float
        Standard deviation of ours over random splits; twice as much is within the tolerance.
    scale : Scale

    Returns
    -------
    Verdict
        Never `NOT_ATTEMPTED`: what is attempted is known by the configuration.
    """
    if ours is None:
        return Verdict.NOT_IN_THIS_RUN
    if printed is None:
        return Verdict.NOT_IN_THE_PAPER
    tolerance = scale.tolerance * abs(printed) if scale.relative else scale.tolerance
    gain = printed - ours if scale.lower_is_better else ours - printed
    if abs(gain) <= max(tolerance, 2 * spread):
        return Verdict.MATCHES
    return Verdict.BETTER if gain > 0 else Verdict.DIFFERS


@dataclass(frozen=True, slots=True)
class Reason:
    """Why some figures differ from the paper's, or are not there.

    Attributes
    ----------
    why : str
    item, row, column, verdict : str
        The figures it is said of, as patterns with ``*``.
    """

    why: str
    item: str = "*"
    row: str = "*"
    column: str = "*"
    verdict: str = "*"

    def applies(self, item: str, row: str, column: str, verdict: Verdict) -> bool:
        """Tell whether it is said of a figure."""
        pairs = ((item, self.item), (row, self.row), (column, self.column))
        return all(fnmatchcase(text, pattern) for text, pattern in pairs) and fnmatchcase(
            verdict, self.verdict
        )


def reason_for(
    reasons: Sequence[Reason], item: str, row: str, column: str, verdict: Verdict
) -> str:
    """Return the first reason that is given for a figure; empty where none is."""
    found = (one.why for one in reasons if one.applies(item, row, column, verdict))
    return next(found, "")


def count(verdicts: Sequence[Verdict]) -> Mapping[Verdict, int]:
    """Count verdicts, in the order of :class:`Verdict`; what is not there is left out."""
    counts = {verdict: sum(one == verdict for one in verdicts) for verdict in Verdict}
    return {verdict: number for verdict, number in counts.items() if number}
