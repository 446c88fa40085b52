"""Dataclasses as rows of a CSV."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any


def as_table(records: Sequence[Any]) -> tuple[list[str], list[list[object]]]:
    """Lay out instances of one dataclass, a row each.

    Returns
    -------
    header : list of str
        Names of the fields.
    rows : list of list
        Numbers are written so that they are read back exactly; NaN is an empty cell.
    """
    header = [field.name for field in fields(records[0])]
    return header, [[_cell(getattr(record, name)) for name in header] for record in records]


def _cell(value: object) -> object:
    return "" if value != value else value
