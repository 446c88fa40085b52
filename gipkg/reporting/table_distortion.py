"""The distortion of the maps, for each method and database (paper, Section 5 and Figure 7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gipkg.files import read_csv
from gipkg.reporting.notes import literal
from gipkg.reporting.score_table import ABSENT, markdown_line
from gipkg.reporting.shapes import MappedShape

_RATIOS = ("face_std", "weighted_face_std", "vertex_std")
FIGURES = ("variance", *_RATIOS, "seconds")
"""Figures of a shape that the table spreads over the shapes."""


@dataclass(frozen=True, slots=True)
class Spread:
    """How a figure varies over shapes."""

    mean: float
    median: float
    worst: float

    @classmethod
    def over(cls, values: Sequence[float]) -> Spread:
        """Take mean, median and maximum; NaN where there is no value."""
        if not values:
            return cls(*(float("nan"),) * 3)
        return cls(float(np.mean(values)), float(np.median(values)), float(np.max(values)))


@dataclass(frozen=True, slots=True)
class Row:
    """One method on one database.

    Attributes
    ----------
    database, parametrizer : str
        Their names in the configuration.
    shapes, failures : int
        With a map, and without.
    vertices : tuple of two ints
        Least and greatest number of vertices of the surfaces mapped.
    variance : float
        The paper's δh·A over the triangles of all shapes together: their variances, each
        weighted by the shape's number of faces.
    spreads : mapping
        Name out of `FIGURES` -> how it varies over the shapes.
    worst_shape : str
        The one with the greatest standard deviation over faces; empty where there is none.
    flipped_shapes, flips : int
        Shapes with flipped faces, and flipped faces of all shapes.
    other_degrees : int
        Shapes whose map covers the sphere not once, but several times or never.
    """

    database: str
    parametrizer: str
    shapes: int
    failures: int
    vertices: tuple[int, int]
    variance: float
    spreads: Mapping[str, Spread]
    worst_shape: str
    flipped_shapes: int
    flips: int
    other_degrees: int


def summarise(database: str, parametrizer: str, shapes: Sequence[MappedShape]) -> Row:
    """Sum up what a method did to the shapes of a database."""
    mapped = [shape for shape in shapes if not shape.failure]
    vertices = [shape.vertices for shape in mapped] or [0]
    triangles = sum(shape.faces for shape in mapped)
    weighted = sum(shape.faces * shape.variance for shape in mapped)
    return Row(
        database,
        parametrizer,
        shapes=len(mapped),
        failures=len(shapes) - len(mapped),
        vertices=(min(vertices), max(vertices)),
        variance=weighted / triangles if mapped else float("nan"),
        spreads={name: Spread.over([getattr(shape, name) for shape in mapped]) for name in FIGURES},
        worst_shape=max(mapped, key=lambda shape: shape.face_std).id if mapped else "",
        flipped_shapes=sum(shape.flips > 0 for shape in mapped),
        flips=sum(shape.flips for shape in mapped),
        other_degrees=sum(not abs(shape.degree - 1) < 0.5 for shape in mapped),
    )


def as_csv(rows: Sequence[Row]) -> tuple[list[str], list[list[str]]]:
    """Lay the table out with every figure in a column of its own; what is not there is empty."""
    parts = Spread.__slots__
    header = ["database", "parametrizer", "shapes", "failures", "vertices least", "vertices most"]
    header += ["variance", *(f"{name} {part}" for name in FIGURES for part in parts)]
    header += ["worst shape", "flipped shapes", "flips", "other degrees"]
    lines = []
    for row in rows:
        spreads = [getattr(row.spreads[name], part) for name in FIGURES for part in parts]
        counts = (row.shapes, row.failures, *row.vertices)
        lines.append(
            [row.database, row.parametrizer, *map(str, counts)]
            + [_number(value, 6, "") for value in (row.variance, *spreads)]
            + [row.worst_shape, *map(str, (row.flipped_shapes, row.flips, row.other_degrees))]
        )
    return header, lines


def read_reference(path: Path) -> dict[tuple[str, str], str]:
    """Read the paper's figures: (database, method) -> variance as printed."""
    return {(row["database"], row["method"]): row["variance"] for row in read_csv(path)}


def as_markdown(
    rows: Sequence[Row],
    in_paper: Mapping[str, str | None],
    reference: Mapping[tuple[str, str], str],
    notes: Sequence[str],
) -> str:
    """Set the table beside the paper's figures.

    Parameters
    ----------
    rows : sequence of Row
    in_paper : mapping
        Parametrizer -> name of the same method in the paper, None where it has none.
    reference : mapping
        From :func:`read_reference`.
    notes : sequence of str
        What a reader has to know, a paragraph each.
    """
    lines = [
        "# Area distortion of the spherical maps",
        "",
        "δh·A is sphere area minus mesh area of a triangle, both surfaces scaled to 4π; its "
        "variance is taken over all triangles, and over those of each shape (mean / median of the "
        "shapes). It falls with the number of faces: compare it within a table only. r is sphere "
        "area over mesh area; its standard deviations, median / worst of the shapes, are over "
        "faces, over faces weighted by their area, and over vertices. Seconds are those of a "
        "processor, the median of the shapes.",
    ]
    for database in dict.fromkeys(row.database for row in rows):
        lines += ["", f"## {literal(database)}", "", *_section(database, rows, in_paper, reference)]
    lines += ["", "## Notes", "", *(f"- {note}" for note in notes)]
    lines += ["", "## The paper's figures", ""]
    lines += [markdown_line(["database", "method", "variance of δh·A"])]
    lines += [markdown_line(["---"] * 3)]
    lines += [markdown_line([*key, variance]) for key, variance in reference.items()]
    return "\n".join(lines) + "\n"


def _section(
    database: str,
    rows: Sequence[Row],
    in_paper: Mapping[str, str | None],
    reference: Mapping[tuple[str, str], str],
) -> list[str]:
    chosen = [row for row in rows if row.database == database]
    header = ["method", "shapes", "failed", "vertices", "var δh·A", "a shape", "*in the paper*"]
    header += ["std r: faces", "weighted", "vertices", "flipped shapes", "flips"]
    header += ["degree not 1", "seconds"]
    lines = [markdown_line(header), markdown_line(["---"] * len(header))]
    for row in chosen:
        variance = row.spreads["variance"]
        printed = reference.get((database, in_paper[row.parametrizer] or ""))
        lines.append(
            markdown_line(
                [
                    literal(row.parametrizer),
                    str(row.shapes),
                    str(row.failures),
                    f"{row.vertices[0]} to {row.vertices[1]}",
                    _number(row.variance, 3),
                    f"{_number(variance.mean, 3)} / {_number(variance.median, 3)}",
                    f"*{printed}*" if printed else ABSENT,
                    *(_pair(row.spreads[name]) for name in _RATIOS),
                    str(row.flipped_shapes),
                    str(row.flips),
                    str(row.other_degrees),
                    _number(row.spreads["seconds"].median, 3),
                ]
            )
        )
    return lines


def _pair(spread: Spread) -> str:
    return f"{_number(spread.median, 3)} / {_number(spread.worst, 3)}"


def _number(value: float, digits: int, absent: str = ABSENT) -> str:
    return absent if np.isnan(value) else f"{value:.{digits}g}"
