from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest

from gipkg.reporting.shapes import MappedShape
from gipkg.reporting.table_distortion import (
    FIGURES,
    as_csv,
    as_markdown,
    read_reference,
    summarise,
)

REFERENCE = Path(__file__).resolve().parents[2] / "results" / "reference" / "table_distortion.csv"


def shape(shape_id: str, faces: int, scale: float, flips: int = 0, degree: float = 1.0):
    figures = {name: scale * (number + 1) for number, name in enumerate(FIGURES)}
    return MappedShape(shape_id, faces // 2 + 2, faces, "", flips=flips, degree=degree, **figures)


SHAPES = [
    shape("a", 100, 1.0),
    shape("b", 300, 5.0, flips=3),
    shape("c", 100, 3.0, degree=2.0),
    MappedShape.failed("d", None, "UnsupportedMesh: open"),
]
ROW = summarise("tosca", "mine", SHAPES)
NOTHING = summarise("made", "mine", SHAPES[3:])


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_the_variance_is_that_of_all_triangles_together() -> None:
    rng = np.random.default_rng(0)
    # Both areas of a shape sum to 4π, so that its differences sum to 0.
    differences = [rng.normal(size=n) for n in (100, 300)]
    differences = [one - one.mean() for one in differences]
    shapes = [
        MappedShape(str(i), 0, len(one), "", variance=np.var(one), degree=1)
        for i, one in enumerate(differences)
    ]
    pooled = np.var(np.concatenate(differences))
    assert summarise("d", "m", shapes).variance == pytest.approx(pooled)


def test_figures_are_spread_over_the_shapes_that_have_a_map() -> None:
    assert (ROW.shapes, ROW.failures) == (3, 1)
    assert ROW.vertices == (52, 152)
    for number, name in enumerate(FIGURES, start=1):
        spread = ROW.spreads[name]
        assert (spread.mean, spread.median, spread.worst) == (3 * number, 3 * number, 5 * number)
    assert ROW.worst_shape == "b"
    assert (ROW.flipped_shapes, ROW.flips, ROW.other_degrees) == (1, 3, 1)


def test_a_method_without_any_map_has_no_figures() -> None:
    assert (NOTHING.shapes, NOTHING.failures, NOTHING.worst_shape) == (0, 1, "")
    header, (line,) = as_csv([NOTHING])
    row = dict(zip(header, line, strict=True))
    assert all(row[name] == "" for name in header if "std" in name or "variance" in name)
    assert "nan" not in as_markdown([NOTHING], {"mine": None}, {}, [])


def test_the_csv_has_a_column_for_every_figure() -> None:
    header, lines = as_csv([ROW])
    (row,) = csv.DictReader(io.StringIO("\n".join(map(",".join, [header, *lines]))))
    assert row["database"] == "tosca"
    assert row["vertices most"] == "152"
    assert float(row["variance"]) == pytest.approx((100 + 1500 + 300) / 500)
    assert float(row["vertex_std worst"]) == pytest.approx(20)
    assert float(row["seconds median"]) == pytest.approx(15)


def test_the_papers_figures_stand_beside_their_database_and_method_only() -> None:
    rows = [ROW, summarise("tosca", "other", SHAPES), summarise("made", "mine", SHAPES)]
    in_paper = {"mine": "Ours", "other": None}
    text = as_markdown(rows, in_paper, {("tosca", "Ours"): "9.8e-8"}, ["A note."])
    lines = [cells(line) for line in text.splitlines() if line.startswith("| `")]
    assert [line[0] for line in lines] == ["`mine`", "`other`", "`mine`"]
    assert ["*9.8e-8*" in line for line in lines] == [True, False, False]
    assert lines[0][1:4] == ["3", "1", "52 to 152"]
    assert "- A note." in text
    assert text.count("## `tosca`") == text.count("## `made`") == 1
    header = next(line for line in text.splitlines() if line.startswith("| method"))
    assert {len(line) for line in lines} == {len(cells(header))}


def test_the_transcription_holds_what_the_paper_prints() -> None:
    # Section 5: "9.8e-8 for our method compared to 5.2e-7 for [35] and 2.65e-7 for [8]".
    assert read_reference(REFERENCE) == {
        ("tosca", "Ours"): "9.8e-8",
        ("tosca", "Lie advection"): "5.2e-7",
        ("tosca", "Penalty"): "2.65e-7",
    }
