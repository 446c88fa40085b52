from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import pytest

from gipkg.reporting.score_table import (
    Cell,
    Reference,
    Row,
    as_csv,
    as_markdown,
    own_columns,
    read_reference,
)

REFERENCES = Path(__file__).resolve().parents[2] / "results" / "reference"

ROWS = [
    Row("shrec11", "SHREC1", {"Mine": Cell((90.0, 92.0), (0.5, 0.6)), "New": Cell((1.0,), (0.1,))}),
    Row("made", "Made1", {"Mine": Cell((50.0, 50.0), (0.25, 0.25)), "New": Cell((2.0,), (0.2,))}),
]


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_the_csv_has_a_column_for_every_figure() -> None:
    header, lines = as_csv(ROWS, ["Mine", "New"])
    assert header == [
        "database",
        "split",
        *("Mine accuracy mean", "Mine accuracy std", "Mine mAP mean", "Mine mAP std"),
        *("New accuracy mean", "New accuracy std", "New mAP mean", "New mAP std"),
    ]
    # Sample standard deviation of 90 and 92 is √2; one split has none.
    assert lines == [
        ["shrec11", "SHREC1", "91.00", "1.41", "0.5500", "0.0707", "1.00", "", "0.1000", ""],
        ["made", "Made1", "50.00", "0.00", "0.2500", "0.0000", "2.00", "", "0.2000", ""],
    ]


def test_of_several_columns_like_the_papers_own_the_one_of_its_name_comes_first() -> None:
    named = {"As printed": "Ours", "Ours": "Ours", "Conf": "Conf", "New": None}
    columns = [{"column": heading, "paper": paper} for heading, paper in named.items()]
    assert own_columns(columns) == ["Ours", "As printed"]


def test_the_papers_figures_stand_below_their_own_row_and_column_only() -> None:
    reference = Reference(("A", "B"), {("SHREC1", "A"): ("88.6", "0.65")})
    text = as_markdown(
        "A title", ROWS, {"Mine": "A", "New": None}, reference, ["First note.", "Second."]
    )
    assert text.startswith("# A title\n")
    lines = [cells(line) for line in text.splitlines() if line.startswith("|")]
    assert lines[0] == ["", "Mine", "New"]
    assert lines[2] == ["**SHREC1**", "91.00 ± 1.41 / 0.5500 ± 0.0707", "1.00 / 0.1000"]
    assert lines[3] == ["*in the paper*", "*88.6 / 0.65*", "–"]
    assert lines[4][0] == "**Made1**"
    assert text.count("in the paper*") == 1
    assert "- First note.\n- Second." in text
    assert all(len(line) == 3 for line in lines)


def test_scores_become_percent_for_every_split() -> None:
    cell = Cell.of(
        [
            {"accuracy": 0.9, "mean_average_precision": 0.5, "seed": 0},
            {"accuracy": 1.0, "mean_average_precision": 0.6, "seed": 1},
        ]
    )
    assert cell == Cell((90.0, 100.0), (0.5, 0.6))


def test_the_transcription_of_table_1_holds_what_the_paper_prints() -> None:
    reference = read_reference(REFERENCES / "table1.csv")
    assert reference.methods == ("SG", "Zer", "LFD", "SN", "Conf", "Sph", "Ours")
    rows = ("McGill1", "McGill2", "SHREC1", "SHREC2")
    absent = {("McGill1", "SG"), ("McGill2", "SG")}  # "NA" in the paper
    assert set(reference.figures) == {(r, m) for r in rows for m in reference.methods} - absent
    assert reference.figures["SHREC2", "Ours"] == ("96.6", "0.72")
    assert reference.figures["McGill2", "Zer"] == ("57.5", "0.69")
    assert reference.figures["SHREC1", "SN"] == ("52.7", "0.10")
    for accuracy, average_precision in reference.figures.values():
        assert re.fullmatch(r"\d\d\.\d", accuracy)
        assert re.fullmatch(r"0\.\d\d", average_precision)


def test_the_transcription_of_table_2_holds_what_the_paper_prints() -> None:
    reference = read_reference(REFERENCES / "table2.csv")
    assert reference.methods == ("VN", "DP", "LFD", "SN", "SH", "Conf", "Sph", "Ours")
    rows = ("ModelNet10", "ModelNet40")
    assert set(reference.figures) == {(r, m) for r in rows for m in reference.methods}
    # The paper prints these mAP in percent, and none for VN.
    assert reference.figures["ModelNet10", "Ours"] == ("88.4", "0.749")
    assert reference.figures["ModelNet10", "VN"] == ("92.0", "")
    assert reference.figures["ModelNet40", "SH"] == ("68.2", "0.344")
    for accuracy, average_precision in reference.figures.values():
        assert re.fullmatch(r"\d\d\.\d", accuracy)
        assert re.fullmatch(r"(0\.\d{3})?", average_precision)


def test_a_figure_that_the_paper_leaves_out_is_shown_as_left_out() -> None:
    reference = Reference(("A",), {("SHREC1", "A"): ("92.0", "")})
    text = as_markdown("T", ROWS[:1], {"Mine": "A"}, reference, [])
    assert "| *in the paper* | *92.0 / –* |" in text
    assert "| SHREC1 | 92.0 / – |" in text


def test_the_csv_is_one_that_readers_of_csv_read() -> None:
    header, lines = as_csv(ROWS, ["Mine", "New"])
    text = "\n".join(",".join(line) for line in [header, *lines])
    (first, _) = csv.DictReader(io.StringIO(text))
    assert float(first["Mine mAP mean"]) == pytest.approx(0.55)
