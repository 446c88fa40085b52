"""What a database's surfaces are: how many, how fine, and what was repaired."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from statistics import median_low
from typing import Any

from gipkg.errors import TooManyFailures


@dataclass(frozen=True, slots=True)
class Survey:
    """Figures that stand in the note of a table.

    Attributes
    ----------
    surfaces : int
        Shapes prepared.
    vertices : tuple of three ints
        Least, median and greatest number of vertices.
    repaired : dict
        Identifier -> names of the steps, of the shapes that were changed.
    failures : dict
        Identifier -> reason, of the shapes that could not be prepared.
    """

    surfaces: int
    vertices: tuple[int, int, int]
    repaired: dict[str, list[str]]
    failures: dict[str, str]


def survey(reports: Mapping[str, Mapping[str, Any]], failures: Mapping[str, str]) -> Survey:
    """Sum up the reports of the surface stage (``Report.as_dict``) over a database.

    Raises
    ------
    TooManyFailures
        There is no report; the message lists the failures.
    """
    vertices = [report["after"]["vertices"] for report in reports.values()]
    if not vertices:
        listing = "".join(f"\n  {shape}: {reason}" for shape, reason in sorted(failures.items()))
        raise TooManyFailures(
            f"no surface was prepared, all {len(failures)} shapes of the database failed; mend "
            "what is said below, or choose another `surface: method` for the database in the "
            f"configuration:{listing}"
        )
    steps = {
        shape_id: [step["name"] for step in report["steps"]] for shape_id, report in reports.items()
    }
    return Survey(
        surfaces=len(vertices),
        vertices=(min(vertices), median_low(vertices), max(vertices)),
        repaired={shape_id: names for shape_id, names in steps.items() if names},
        failures=dict(failures),
    )
