"""The table beyond the paper and its figure show the same figures."""

from __future__ import annotations

import pytest

from gipkg.reporting.figures import beyond
from gipkg.reporting.score_table import Cell
from gipkg.reporting.table_beyond import CLEAN, FEW_SHOT, Row, as_csv, as_markdown


def row(experiment: str, setting: str, amount: str, *accuracies: float) -> Row:
    ours = Cell(accuracies, tuple(one / 200 for one in accuracies))
    other = Cell(tuple(one / 2 for one in accuracies), (0.25,) * len(accuracies))
    return Row(experiment, setting, amount, len(accuracies), {"Other": other, "Ours": ours})


ROWS = [
    row("few-shot", FEW_SHOT, "1", 50, 54),
    row("few-shot", FEW_SHOT, "5", 80, 84),
    row("robustness", CLEAN, "", 90),
    row("robustness", "noise", "0.1", 88),
    row("robustness", "noise", "0.4", 60),
    row("robustness", "holes", "0.05", 89),
]


def test_a_line_a_setting_and_four_figures_a_column() -> None:
    header, lines = as_csv(ROWS)
    assert header[:4] == ["experiment", "setting", "amount", "splits"]
    assert header[4:] == [
        f"{column} {metric} {part}"
        for column in ("Other", "Ours")
        for metric in ("accuracy", "mAP")
        for part in ("mean", "std")
    ]
    assert lines[0][:4] == ["few-shot", FEW_SHOT, "1", "2"]
    assert lines[0][8:] == ["52.00", "2.83", "0.2600", "0.0141"]
    assert lines[4] == [
        *("robustness", "noise", "0.4", "1"),
        *("30.00", "", "0.2500", "", "60.00", "", "0.3000", ""),
    ]


def test_each_experiment_has_its_part_of_the_page() -> None:
    text = as_markdown(ROWS, ["A note."])
    few, faulty = text.index("## Few training"), text.index("## Trained on surfaces as they are")
    assert few < text.index("| training shapes a class | 5 |") < faulty
    assert faulty < text.index("| as they are |  | 45.00 / 0.2500 | 90.00 / 0.4500 |")
    assert faulty < text.index("| noise | 0.4 |") < text.index("- A note.")


def test_the_panels_of_faults_begin_with_the_shapes_as_they_are() -> None:
    figure = beyond.draw(ROWS, {"Ours"})
    assert [axes.get_title() for axes in figure.axes[:3]] == [FEW_SHOT, "noise", "holes"]
    ticks = [[one.get_text() for one in axes.get_xticklabels()] for axes in figure.axes[:3]]
    assert ticks == [["1", "5"], ["none", "0.1", "0.4"], ["none", "0.05"]]
    drawn = {line.get_label(): list(line.get_ydata()) for line in figure.axes[1].lines}
    assert drawn == {"Other": [45, 44, 30], "Ours": [90, 88, 60]}
    below = {line.get_label(): list(line.get_ydata()) for line in figure.axes[4].lines}
    assert below == {"Other": [0.25] * 3, "Ours": [0.45, 0.44, 0.3]}
    points = beyond.points(ROWS)
    assert len(points) == 2 * len(ROWS)
    assert (points[1].setting, points[1].amount, points[1].column) == (FEW_SHOT, "1", "Ours")
    assert points[1].accuracy == pytest.approx(52)
