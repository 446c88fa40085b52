"""The figure beyond the paper: what few training shapes and faulty test shapes cost."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gipkg.reporting.colours import INK
from gipkg.reporting.figures.layout import page
from gipkg.reporting.figures.methods import styles
from gipkg.reporting.score_table import METRICS
from gipkg.reporting.table_beyond import CLEAN, Row

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE = 2.2
"""Inches of a panel, along each side."""

_LABELS = {"accuracy": "accuracy in %", "mAP": "mean average precision"}
_TOP = {"accuracy": 100, "mAP": 1}


@dataclass(frozen=True, slots=True)
class Point:
    """A row of the CSV: a column of the table in one setting."""

    setting: str
    amount: str
    column: str
    accuracy: float
    mAP: float  # noqa: N815 - its name in the literature


def points(rows: Sequence[Row]) -> list[Point]:
    """Return the means that are drawn."""
    return [
        Point(row.setting, row.amount, column, cell.mean("accuracy"), cell.mean("mAP"))
        for row in rows
        for column, cell in row.cells.items()
    ]


def draw(rows: Sequence[Row], emphasised: Collection[str] = ()) -> Figure:
    """Draw accuracy above and mAP below, a panel a setting and a line a column.

    The panels of faults begin with the shapes as they are.

    Parameters
    ----------
    rows : sequence of Row
    emphasised : collection of str
        Columns that are drawn thick.
    """
    settings = [name for name in dict.fromkeys(row.setting for row in rows) if name != CLEAN]
    looks = styles(list(rows[0].cells), emphasised)
    figure = page(SIDE * len(settings) + 1.8, 2 * SIDE + 0.6)
    grid = figure.subplots(2, len(settings), squeeze=False, sharey="row")
    for number, setting in enumerate(settings):
        shown = [row for row in rows if row.setting == setting]
        before = [row for row in rows if row.setting == CLEAN]
        if shown[0].experiment == before[0].experiment:
            shown = [*before, *shown]
        grid[0, number].set_title(setting, fontsize=9, color=INK)
        for axes, metric in zip(grid[:, number], METRICS, strict=True):
            for column, look in looks.items():
                axes.plot([row.cells[column].mean(metric) for row in shown], label=column, **look)
            _label(axes, [row.amount or "none" for row in shown], _TOP[metric])
    for axes, metric in zip(grid[:, 0], METRICS, strict=True):
        axes.set_ylabel(_LABELS[metric], fontsize=9, color=INK)
    lines, names = grid[0, 0].get_legend_handles_labels()
    figure.legend(lines, names, loc="outside right upper", frameon=False, fontsize=8)
    return figure


def _label(axes: Axes, amounts: Sequence[str], top: float) -> None:
    axes.set_xticks(range(len(amounts)), amounts)
    axes.set_ylim(0, 1.02 * top)
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8, colors=INK)
