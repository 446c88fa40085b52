"""What the paper holds, as data: its tables, its figures, and why ours may differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gipkg.reporting.page.verdicts import Reason, Scale


@dataclass(frozen=True, slots=True)
class Claim:
    """Something that a figure of the paper shows, as a condition on the numbers of ours.

    Attributes
    ----------
    says : str
    table : str
        Name of the CSV, in the folder of the results.
    column : str
        Of the value.
    where : mapping
        Column -> pattern with ``*``: the rows that are looked at.
    take : str
        ``min``, ``max``, ``mean``, ``first`` or ``last`` of the values of these rows.
    at_least, at_most : float or None
    """

    says: str
    table: str
    column: str
    where: Mapping[str, str] = field(default_factory=dict)
    take: str = "first"
    at_least: float | None = None
    at_most: float | None = None


@dataclass(frozen=True, slots=True)
class Item:
    """A table or a figure.

    Attributes
    ----------
    name : str
        Of its files: ``figure2`` for ``figure2.png``, ``figure2.csv`` and ``figure2.json``.
    title : str
    paper : str
        What the paper shows there, in our words.
    claims : tuple of Claim
    """

    name: str
    title: str
    paper: str
    claims: tuple[Claim, ...] = ()


@dataclass(frozen=True, slots=True)
class Paper:
    """All that is known of the paper's results.

    Attributes
    ----------
    items : tuple of Item
        In the order of the page.
    scales : mapping
        Name of a quantity -> when two values are the same.
    reasons : tuple of Reason
    """

    items: tuple[Item, ...]
    scales: Mapping[str, Scale]
    reasons: tuple[Reason, ...]


def read_paper(path: Path) -> Paper:
    """Read the description of the paper's results.

    Raises
    ------
    TypeError
        A key of it is not known, or one is missing.
    """
    import yaml

    content: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    items = [
        Item(**{**item, "claims": tuple(Claim(**one) for one in item.get("claims", ()))})
        for item in content["items"]
    ]
    scales = {name: Scale(**scale) for name, scale in content["scales"].items()}
    return Paper(tuple(items), scales, tuple(Reason(**one) for one in content["reasons"]))
