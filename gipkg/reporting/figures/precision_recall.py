"""Figure 8: how precise a retrieval stays while it finds more, on each split of a table."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gipkg.evaluation.retrieval import RECALL_LEVELS
from gipkg.reporting.colours import INK
from gipkg.reporting.figures.layout import page
from gipkg.reporting.figures.methods import styles

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE = 2.6
"""Inches of a panel, along each side."""

ACROSS = 4
"""Panels in a row, at most."""


@dataclass(frozen=True, slots=True)
class Point:
    """A row of the CSV: one recall level of a curve.

    Attributes
    ----------
    database, split : str
        The panel: a database and the name of its protocol.
    column : str
        Heading of the method in the table.
    recall : float
    precision : float
        Interpolated, mean over the queries and then over the random splits.
    std : float
        Sample standard deviation over the random splits; NaN of one.
    """

    database: str
    split: str
    column: str
    recall: float
    precision: float
    std: float


def curve(
    database: str, split: str, column: str, scores: Sequence[Mapping[str, Any]]
) -> tuple[Point, ...]:
    """Average the curves of all random splits (:class:`gipkg.evaluation.scores.Scores`, as JSON).

    Returns
    -------
    tuple of Point
        One for each of the standard recall levels.
    """
    precision = np.array([one["precision"] for one in scores])
    spread = (
        precision.std(axis=0, ddof=1) if len(scores) > 1 else np.full(len(RECALL_LEVELS), np.nan)
    )
    points = zip(RECALL_LEVELS, precision.mean(axis=0), spread, strict=True)
    # Levels are tenths; they are written as such.
    return tuple(
        Point(database, split, column, round(float(level), 1), float(mean), float(std))
        for level, mean, std in points
    )


def draw(points: Sequence[Point], emphasised: Collection[str] = ()) -> Figure:
    """Draw a panel for every split and a curve in it for every column.

    Parameters
    ----------
    points : sequence of Point
        Of all curves, those of one curve in the order of their recall.
    emphasised : collection of str
        Columns that are drawn thick.
    """
    panels = list(dict.fromkeys((point.database, point.split) for point in points))
    looks = styles(list(dict.fromkeys(point.column for point in points)), emphasised)
    across = min(ACROSS, len(panels))
    down = math.ceil(len(panels) / across)
    figure = page(SIDE * across + 1.8, SIDE * down + 0.4)
    grid = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    for axes in grid.flat[len(panels) :]:
        axes.set_visible(False)
    for axes, panel in zip(grid.flat, panels, strict=False):
        shown = [point for point in points if (point.database, point.split) == panel]
        _draw_panel(axes, panel[1], shown, looks)
    for axes in grid[:, 0]:
        axes.set_ylabel("precision", fontsize=9, color=INK)
    # Below every panel that has none below it.
    for axes in grid.flat[max(0, len(panels) - across) : len(panels)]:
        axes.set_xlabel("recall", fontsize=9, color=INK)
        axes.tick_params(labelbottom=True)
    lines, names = grid[0, 0].get_legend_handles_labels()
    figure.legend(lines, names, loc="outside right upper", frameon=False, fontsize=8)
    return figure


def _draw_panel(
    axes: Axes, title: str, points: Sequence[Point], looks: Mapping[str, Mapping[str, Any]]
) -> None:
    for column, look in looks.items():
        recall, precision = _curve_of(column, points)
        axes.plot(recall, precision, label=column, clip_on=False, **look)
    axes.set_title(title, fontsize=10, color=INK)
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 1)
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8, colors=INK)


def _curve_of(column: str, points: Sequence[Point]) -> tuple[NDArray[np.float64], ...]:
    found = [(point.recall, point.precision) for point in points if point.column == column]
    return tuple(np.array(found).T)
