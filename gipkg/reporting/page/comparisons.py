"""The tables of a run beside the paper's: every figure of either, and its verdict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gipkg.reporting.page.reference import Paper
from gipkg.reporting.page.verdicts import Verdict, judge, reason_for
from gipkg.reporting.score_table import METRICS
from gipkg.reporting.score_table import Reference as ScoreReference

Row = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Figure:
    """One quantity in a cell: ours, the paper's, and what is to be said of them.

    Attributes
    ----------
    quantity : str
    ours, printed : str
        As they are shown; empty where there is none.
    verdict : Verdict
    why : str
        The reason, where one is given.
    """

    quantity: str
    ours: str
    printed: str
    verdict: Verdict
    why: str


@dataclass(frozen=True, slots=True)
class Cell:
    """A method on a row."""

    row: str
    column: str
    figures: tuple[Figure, ...]


@dataclass(frozen=True, slots=True)
class Comparison:
    """A table of ours and of the paper in one.

    Attributes
    ----------
    rows, columns : tuple of str
        Ours first, then what the paper alone has.
    cells : mapping
        (row, column) -> cell; what neither has is left out.
    """

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    cells: Mapping[tuple[str, str], Cell]

    @property
    def verdicts(self) -> list[Verdict]:
        """Of all figures, but those that the paper does not have."""
        figures = [figure for cell in self.cells.values() for figure in cell.figures]
        return [one.verdict for one in figures if one.verdict != Verdict.NOT_IN_THE_PAPER]


def compare_scores(
    name: str,
    rows: Sequence[Row],
    columns: Sequence[Mapping[str, Any]],
    reference: ScoreReference,
    paper: Paper,
) -> Comparison:
    """Set Table 1 or 2 beside the paper's.

    Parameters
    ----------
    name : str
        ``table1``.
    rows : sequence of mappings
        Of the table's CSV (:func:`gipkg.reporting.score_table.as_csv`); none where this run
        has no such table.
    columns : sequence of mappings
        Of the configuration.
    reference : Reference
        The paper's table.
    paper : Paper
    """
    in_paper = {column["column"]: column.get("paper") for column in columns}
    ours = {row["split"]: row for row in rows}
    splits = tuple(dict.fromkeys([*ours, *(split for split, _ in reference.figures)]))
    left = [method for method in reference.methods if method not in in_paper.values()]
    cells = {}
    for split in splits:
        for column, method in [*in_paper.items(), *((one, one) for one in left)]:
            printed = reference.figures.get((split, method or ""), ("", ""))
            made = ours.get(split, {}) if column in in_paper else {}
            if not made and not any(printed):
                continue
            figures = []
            for quantity, text in zip(METRICS, printed, strict=True):
                value = made.get(f"{column} {quantity} mean", "")
                if not (value or text):
                    continue
                spread = made.get(f"{column} {quantity} std", "")
                figures.append(
                    _figure(
                        (name, split, column),
                        quantity,
                        value,
                        spread,
                        text,
                        column in in_paper or not rows,
                        paper,
                    )
                )
            cells[split, column] = Cell(split, column, tuple(figures))
    return Comparison(splits, (*in_paper, *left), cells)


def compare_distortion(
    rows: Sequence[Row],
    methods: Mapping[str, str | None],
    reference: Mapping[tuple[str, str], str],
    paper: Paper,
) -> Comparison:
    """Set the distortion table beside the paper's figures: a row a method, a column a database.

    Parameters
    ----------
    rows : sequence of mappings
        Of the table's CSV (:func:`gipkg.reporting.table_distortion.as_csv`).
    methods : mapping
        Parametrizer -> name of the same method in the paper, or None.
    reference : mapping
        From :func:`gipkg.reporting.table_distortion.read_reference`.
    paper : Paper
    """
    ours = {(row["parametrizer"], row["database"]): row for row in rows}
    databases = tuple(
        dict.fromkeys([*(key[1] for key in ours), *(database for database, _ in reference)])
    )
    cells = {}
    for method, name in methods.items():
        for database in databases:
            printed = reference.get((database, name or ""), "")
            value = ours.get((method, database), {}).get("variance", "")
            if value or printed:
                where = ("table_distortion", method, database)
                figure = _figure(where, "variance", value, "", printed, True, paper)
                cells[method, database] = Cell(method, database, (figure,))
    return Comparison(tuple(methods), databases, cells)


def _figure(
    where: tuple[str, str, str],
    quantity: str,
    value: str,
    spread: str,
    printed: str,
    attempted: bool,
    paper: Paper,
) -> Figure:
    number = float(value) if value else None
    verdict = judge(
        number, float(printed) if printed else None, float(spread or 0), paper.scales[quantity]
    )
    if not attempted:
        verdict = Verdict.NOT_ATTEMPTED
    shown = f"{value} ± {spread}" if value and spread else value
    return Figure(quantity, shown, printed, verdict, reason_for(paper.reasons, *where, verdict))
