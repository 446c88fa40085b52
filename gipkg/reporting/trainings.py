"""What training and predicting took, method by method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import mean
from typing import Any


@dataclass(frozen=True, slots=True)
class Training:
    """A column of a table on one row.

    Attributes
    ----------
    database, split : str
        The row.
    column : str
    seconds_trainings : int
        Trainings that ran from beginning to end; of one that was killed and resumed, only the rest
        is known, and it does not count.
    seconds_cpu, seconds_wall : float
        Their mean, training and prediction of the test part together; NaN of none.
    """

    database: str
    split: str
    column: str
    seconds_trainings: int
    seconds_cpu: float
    seconds_wall: float

    @classmethod
    def of(
        cls, database: str, split: str, column: str, timings: Sequence[Mapping[str, Any]]
    ) -> Training:
        """Sum up what was measured (``cpu``, ``wall`` and whether ``resumed``) for each seed."""
        whole = [one for one in timings if not one["resumed"]]
        cpu, wall = (
            mean(one[clock] for one in whole) if whole else float("nan")
            for clock in ("cpu", "wall")
        )
        return cls(database, split, column, len(whole), cpu, wall)
