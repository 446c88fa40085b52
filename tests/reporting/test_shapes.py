from __future__ import annotations

from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pytest

from gipkg.evaluation.distortion import Distortion
from gipkg.reporting.shapes import MappedShape, read_shapes, repairs, write_shapes

STEPS = [
    {"name": "fill holes", "figures": {"holes": 3}},
    {"name": "cut handles", "figures": {"handles": 2, "loop lengths": [1.25, 10 / 3]}},
]
REPORT = {"after": {"vertices": 12, "faces": 20}, "steps": STEPS}
MEASURED = Distortion(np.ones(20), np.ones(20), 2, 0.99, 0.5, 0.25, 0.125, 9.8e-8)


def test_what_was_done_to_a_surface_stands_in_a_line() -> None:
    expected = "fill holes (holes 3); cut handles (handles 2, loop lengths 1.25 3.333)"
    assert repairs(REPORT) == expected
    assert repairs({"steps": []}) == "as it was"


def test_a_mapped_shape_takes_its_figures_from_where_they_are_measured() -> None:
    shape = MappedShape.mapped("cat0", REPORT, MEASURED, 1.5)
    assert (shape.vertices, shape.faces, shape.surface) == (12, 20, repairs(REPORT))
    for name in ("variance", "face_std", "weighted_face_std", "vertex_std", "flips", "degree"):
        assert getattr(shape, name) == getattr(MEASURED, name)
    assert (shape.seconds, shape.failure) == (1.5, "")


def test_rows_come_back_from_the_file_and_what_is_absent_is_empty(tmp_path: Path) -> None:
    mapped = MappedShape.mapped("a,b", REPORT, MEASURED, 1.5)
    unmapped = MappedShape.failed("c", REPORT, "ParametrizationError: it\nfolds")
    lost = MappedShape.failed("d", None, "UnsupportedMesh: open")
    path = tmp_path / "shapes.csv"
    write_shapes(path, [mapped, unmapped, lost])
    assert path.read_text().split("\n")[-3] == "d,0,0,failed,,,,,0,,,UnsupportedMesh: open"
    again = read_shapes(path)
    assert again[0] == mapped
    assert replace(again[1], **dict.fromkeys(absent(again[1]), 0.0)) == replace(
        unmapped, **dict.fromkeys(absent(unmapped), 0.0)
    )
    assert again[2].failure == lost.failure


def absent(shape: MappedShape) -> list[str]:
    """Return the names of the figures that are not there."""
    names = [
        name
        for name, value in zip(MappedShape.__slots__, astuple(shape), strict=True)
        if isinstance(value, float) and np.isnan(value)
    ]
    assert len(names) == 6
    return names


def test_a_figure_keeps_six_digits(tmp_path: Path) -> None:
    measured = replace(MEASURED, variance=1.2345678e-11, degree=1 - 1e-13)
    write_shapes(tmp_path / "s.csv", [MappedShape.mapped("a", REPORT, measured, 0.1)])
    (shape,) = read_shapes(tmp_path / "s.csv")
    assert shape.variance == pytest.approx(1.2345678e-11, rel=1e-6)
    assert shape.degree == 1
