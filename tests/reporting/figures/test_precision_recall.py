"""Figure 8: the curves are the means of the splits', a panel a row of the table."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from gipkg.evaluation.retrieval import RECALL_LEVELS
from gipkg.reporting.colours import INK
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.figures.methods import styles
from gipkg.reporting.figures.precision_recall import Point, curve, draw

FALLING = np.linspace(1, 0.2, 11)
SPLITS = [("shrec11", "SHREC1"), ("shrec11", "SHREC2"), ("mcgill", "McGill1")]


def points(columns: dict[str, float]) -> list[Point]:
    return [
        point
        for split in SPLITS
        for column, factor in columns.items()
        for point in curve(*split, column, [{"precision": list(factor * FALLING)}])
    ]


def test_a_curve_is_the_mean_over_the_splits_with_its_deviation() -> None:
    scores = [{"precision": list(FALLING)}, {"precision": list(FALLING / 2)}]
    found = curve("mcgill", "McGill1", "Ours", scores)
    assert [point.recall for point in found] == [n / 10 for n in range(11)]
    assert [point.recall for point in found] == pytest.approx(RECALL_LEVELS)
    np.testing.assert_allclose([point.precision for point in found], 0.75 * FALLING)
    np.testing.assert_allclose([point.std for point in found], FALLING / 2 / math.sqrt(2))
    assert {(point.database, point.split, point.column) for point in found} == {
        ("mcgill", "McGill1", "Ours")
    }
    assert math.isnan(curve("mcgill", "McGill1", "Ours", scores[:1])[0].std)


def test_a_panel_a_split_and_a_line_a_column(tmp_path: Path) -> None:
    figure = draw(points({"A": 1.0, "Ours": 0.5, "C": 0.25}), {"Ours"})
    panels = [axes for axes in figure.axes if axes.get_visible()]
    assert [axes.get_title() for axes in panels] == ["SHREC1", "SHREC2", "McGill1"]
    for axes in panels:
        lines = {line.get_label(): line for line in axes.lines}
        assert list(lines) == ["A", "Ours", "C"]
        for name, factor in {"A": 1.0, "Ours": 0.5, "C": 0.25}.items():
            np.testing.assert_allclose(lines[name].get_xdata(), RECALL_LEVELS)
            np.testing.assert_allclose(lines[name].get_ydata(), factor * FALLING)
        assert to_rgb(lines["Ours"].get_color()) == INK
        assert lines["Ours"].get_linewidth() > lines["A"].get_linewidth()
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["A", "Ours", "C"]
    for name in ("one.png", "two.png"):
        write_png(tmp_path / name, figure)
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()


def test_no_two_methods_look_alike() -> None:
    methods = [f"method {number}" for number in range(20)]
    looks = styles(methods, {"method 3", "method 7"})
    assert list(looks) == methods
    assert len({(tuple(one["color"]), one["linestyle"]) for one in looks.values()}) == 20
