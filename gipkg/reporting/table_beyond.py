"""Beyond the paper: few training shapes, and shapes with faults that no training shape has."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from gipkg.reporting.score_table import Cell, figure_names, figures_of, markdown_line, measured

FEW_SHOT = "training shapes a class"
"""Heading of the rows that differ in how many shapes of each class train."""

CLEAN = "as they are"
"""What is said of test shapes without a fault."""

TITLES = {
    "few-shot": "Few training shapes",
    "robustness": "Trained on surfaces as they are, tested on faulty ones",
}


@dataclass(frozen=True, slots=True)
class Row:
    """One setting under all columns.

    Attributes
    ----------
    experiment : {"few-shot", "robustness"}
    setting : str
        `FEW_SHOT`, `CLEAN` or the name of a perturbation.
    amount : str
        How many train, or how strong it is; empty for `CLEAN`.
    splits : int
        Random splits that the figures are means of.
    cells : mapping
        Heading of a column -> its values.
    """

    experiment: str
    setting: str
    amount: str
    splits: int
    cells: Mapping[str, Cell]


def as_csv(rows: Sequence[Row]) -> tuple[list[str], list[list[str]]]:
    """Lay the table out with every figure in a column of its own.

    Returns
    -------
    header : list of str
        The fields of a row, and for every column mean and sample standard deviation of accuracy
        and mAP over the random splits.
    lines : list of list of str
        A standard deviation of a single split is empty.
    """
    header = ["experiment", "setting", "amount", "splits", *figure_names(rows[0].cells)]
    lines = [
        [row.experiment, row.setting, row.amount, str(row.splits), *figures_of(row.cells.values())]
        for row in rows
    ]
    return header, lines


def as_markdown(rows: Sequence[Row], notes: Sequence[str]) -> str:
    """Set the table for readers, a part for each experiment.

    Parameters
    ----------
    rows : sequence of Row
    notes : sequence of str
        What a reader has to know, a paragraph each.
    """
    lines = ["# Beyond the paper: few training shapes, and faulty test shapes", ""]
    lines += ["Accuracy in % / mean average precision: mean ± standard deviation over the splits."]
    for experiment, title in TITLES.items():
        columns = list(rows[0].cells)
        lines += ["", f"## {title}", "", markdown_line(["", "", *columns])]
        lines.append(markdown_line(["---"] * (len(columns) + 2)))
        lines += [
            markdown_line([row.setting, row.amount, *map(measured, row.cells.values())])
            for row in rows
            if row.experiment == experiment
        ]
    lines += ["", "## Notes", "", *(f"- {note}" for note in notes)]
    return "\n".join(lines) + "\n"
