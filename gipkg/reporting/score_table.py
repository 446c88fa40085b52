"""Tables 1 and 2 of the paper: classification and retrieval, a row a database and split."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import mean, stdev
from typing import Any

from gipkg.files import read_csv

TITLES = {
    "table1": "Table 1: classification and retrieval of non-rigid shapes",
    "table2": "Table 2: classification and retrieval of rigid shapes",
    "table1_study": "Table 1: what one kind of channel does",
    "table2_study": "Table 2: what size, channels and turns of the images do",
}
METRICS = ("accuracy", "mAP")
"""Accuracy in percent, mean average precision in 0 to 1, as the paper prints them."""

DIGITS = {"accuracy": 2, "mAP": 4}
"""Digits after the point."""

OWN = "Ours"
"""What the paper calls its own method."""

ABSENT = "–"
"""What stands in a table for readers where there is no figure."""


@dataclass(frozen=True, slots=True)
class Cell:
    """What one method reached on one row: a value for each random split, per metric."""

    accuracy: tuple[float, ...]
    mAP: tuple[float, ...]  # noqa: N815 - its name in the literature

    @classmethod
    def of(cls, scores: Sequence[Mapping[str, Any]]) -> Cell:
        """Gather the scores of all splits (:class:`gipkg.evaluation.scores.Scores`, as JSON)."""
        return cls(
            accuracy=tuple(100 * split["accuracy"] for split in scores),
            mAP=tuple(split["mean_average_precision"] for split in scores),
        )

    def mean(self, metric: str) -> float:
        """Return the mean of a metric over the splits."""
        return mean(getattr(self, metric))


@dataclass(frozen=True, slots=True)
class Row:
    """A database under one protocol.

    Attributes
    ----------
    database : str
        Its name in the configuration.
    split : str
        Name of the protocol, which is the name of the row in the paper if it is there.
    cells : mapping
        Heading of a column -> its values.
    """

    database: str
    split: str
    cells: Mapping[str, Cell]


@dataclass(frozen=True, slots=True)
class Reference:
    """The paper's own figures.

    Attributes
    ----------
    methods : tuple of str
        Its columns, in order.
    figures : dict
        (row, method) -> accuracy in percent and mAP in 0 to 1 with the digits printed; what the
        paper leaves out is left out, and is empty where it leaves out the mAP alone.
    """

    methods: tuple[str, ...]
    figures: Mapping[tuple[str, str], tuple[str, str]]


def read_reference(path: Path) -> Reference:
    """Read the paper's table from its transcription."""
    rows = read_csv(path)
    methods = tuple(name.removesuffix(" mAP") for name in rows[0] if name.endswith(" mAP"))
    figures = {
        (row["database"], method): (row[f"{method} accuracy"], row[f"{method} mAP"])
        for row in rows
        for method in methods
        if row[f"{method} accuracy"]
    }
    return Reference(methods, figures)


def own_columns(columns: Iterable[Mapping[str, Any]]) -> list[str]:
    """Return the headings of the columns that are set against the paper's own, its name first."""
    own = (column["column"] for column in columns if column.get("paper") == OWN)
    return sorted(own, key=lambda heading: heading != OWN)


def as_csv(rows: Sequence[Row], columns: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    """Lay the table out with every figure in a column of its own.

    Returns
    -------
    header : list of str
        ``database``, ``split``, and four for every column: mean and sample standard deviation
        of accuracy and mAP over the random splits.
    lines : list of list of str
        A standard deviation of a single split is empty.
    """
    header = ["database", "split", *figure_names(columns)]
    lines = [
        [row.database, row.split, *figures_of(row.cells[column] for column in columns)]
        for row in rows
    ]
    return header, lines


def figure_names(columns: Iterable[str]) -> list[str]:
    """Name the four figures of each column: mean and deviation of each metric."""
    return [
        f"{column} {metric} {part}"
        for column in columns
        for metric in METRICS
        for part in ("mean", "std")
    ]


def figures_of(cells: Iterable[Cell]) -> list[str]:
    """Write the four figures of each cell, in the order of :func:`figure_names`."""
    return [figure for cell in cells for metric in METRICS for figure in mean_and_std(cell, metric)]


def as_markdown(
    title: str,
    rows: Sequence[Row],
    columns: Mapping[str, str | None],
    reference: Reference,
    notes: Sequence[str],
) -> str:
    """Set the table beside the paper's.

    Parameters
    ----------
    title : str
    rows : sequence of Row
    columns : mapping
        Heading -> name of the same method in the paper, None where it has none.
    reference : Reference
    notes : sequence of str
        What a reader has to know, a paragraph each.
    """
    lines = [
        f"# {title}",
        "",
        "Accuracy in % / mean average precision: mean ± standard deviation over seeds.",
        "The paper's own figures stand below ours, in italics.",
        "",
        markdown_line(["", *columns]),
        markdown_line(["---"] * (len(columns) + 1)),
    ]
    for row in rows:
        lines.append(
            markdown_line([f"**{row.split}**", *(measured(row.cells[name]) for name in columns)])
        )
        printed = [reference.figures.get((row.split, name or "")) for name in columns.values()]
        if any(printed):
            cells = [f"*{_as_printed(figures)}*" if figures else ABSENT for figures in printed]
            lines.append(markdown_line(["*in the paper*", *cells]))
    lines += ["", "## Notes", "", *(f"- {note}" for note in notes)]
    lines += ["", "## The paper's table in full", "", *_printed(reference)]
    return "\n".join(lines) + "\n"


def _printed(reference: Reference) -> list[str]:
    splits = list(dict.fromkeys(split for split, _ in reference.figures))
    cells = {key: _as_printed(figures) for key, figures in reference.figures.items()}
    return [
        markdown_line(["", *reference.methods]),
        markdown_line(["---"] * (len(reference.methods) + 1)),
        *(
            markdown_line(
                [split, *(cells.get((split, name), ABSENT) for name in reference.methods)]
            )
            for split in splits
        ),
    ]


def _as_printed(figures: tuple[str, str]) -> str:
    return " / ".join(figure or ABSENT for figure in figures)


def measured(cell: Cell) -> str:
    """Write a cell for readers."""
    figures = (mean_and_std(cell, metric) for metric in METRICS)
    return " / ".join(f"{value} ± {std}" if std else value for value, std in figures)


def mean_and_std(cell: Cell, metric: str) -> tuple[str, str]:
    """Write a metric's mean and sample standard deviation, empty of a single split."""
    values, digits = getattr(cell, metric), DIGITS[metric]
    std = f"{stdev(values):.{digits}f}" if len(values) > 1 else ""
    return f"{mean(values):.{digits}f}", std


def markdown_line(cells: Sequence[str]) -> str:
    """Write a line of a table."""
    return f"| {' | '.join(cells)} |"
