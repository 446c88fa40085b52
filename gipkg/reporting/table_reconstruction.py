"""What geometry images keep of shapes: the claim of the paper's Figure 2 as numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from gipkg.reporting.notes import literal
from gipkg.reporting.score_table import ABSENT, markdown_line


@dataclass(frozen=True, slots=True)
class Entry:
    """One shape, seen through an image of one size under one method.

    Attributes
    ----------
    database, parametrizer : str
        Their names in the configuration.
    id : str
    size : int
        Pixels along a side of the image.
    hausdorff, mean : float or None
        As in :class:`gipkg.evaluation.surface_distance.SurfaceDistance`; None without an image.
    failure : str
        Why there is no image.
    """

    database: str
    parametrizer: str
    id: str
    size: int
    hausdorff: float | None
    mean: float | None
    failure: str

    @classmethod
    def of(cls, database: str, parametrizer: str, row: Mapping[str, str]) -> Entry:
        """Read a row of the table of one method and database."""
        hausdorff, mean = (
            float(row[name]) if row[name] else None for name in ("hausdorff", "mean")
        )
        size = int(row["size"])
        return cls(database, parametrizer, row["id"], size, hausdorff, mean, row["failure"])


def as_csv(
    entries: Sequence[Entry], parametrizers: Sequence[str]
) -> tuple[list[str], list[list[str]]]:
    """Lay the table out, a line for each shape and size and two columns for each method.

    Returns
    -------
    header : list of str
    lines : list of list of str
        A distance that is not there is empty.
    """
    header = ["database", "shape", "size"]
    header += [f"{name} {figure}" for name in parametrizers for figure in ("hausdorff", "mean")]
    cells = {(one.database, one.id, one.size, one.parametrizer): one for one in entries}
    keys = dict.fromkeys(key[:3] for key in cells)
    lines = []
    for key in keys:
        found = [cells[*key, name] for name in parametrizers]
        figures = [figure for one in found for figure in (one.hausdorff, one.mean)]
        texts = ["" if figure is None else f"{figure:.6g}" for figure in figures]
        lines.append([*map(str, key), *texts])
    return header, lines


def as_markdown(
    entries: Sequence[Entry], parametrizers: Sequence[str], notes: Sequence[str]
) -> str:
    """Sum the table up over the shapes, for readers.

    Parameters
    ----------
    entries : sequence of Entry
    parametrizers : sequence of str
        The columns.
    notes : sequence of str
        What a reader has to know, a paragraph each.
    """
    lines = [
        "# What a geometry image keeps of a shape",
        "",
        "Distance between a surface and the mesh that its geometry image gives back, in percent of "
        "the bounding box diagonal: Hausdorff distance, median / worst of the shapes, and the mean "
        "distance in brackets, median of the shapes. Measured both ways, from the vertices and "
        "50,000 random points of each surface to the faces of the other.",
        "",
        markdown_line(["database", "shapes", "image", *map(literal, parametrizers)]),
        markdown_line(["---"] * (3 + len(parametrizers))),
    ]
    for database, size in dict.fromkeys((one.database, one.size) for one in entries):
        group = [one for one in entries if (one.database, one.size) == (database, size)]
        shapes = len({one.id for one in group})
        cells = [
            _cell([one for one in group if one.parametrizer == name]) for name in parametrizers
        ]
        lines.append(markdown_line([literal(database), str(shapes), f"{size} × {size}", *cells]))
    lines += ["", "## Notes", "", *(f"- {note}" for note in notes)]
    return "\n".join(lines) + "\n"


def _cell(entries: Sequence[Entry]) -> str:
    largest = [100 * one.hausdorff for one in entries if one.hausdorff is not None]
    mean = [100 * one.mean for one in entries if one.mean is not None]
    if not largest:
        return ABSENT
    return f"{median(largest):.2f} / {max(largest):.2f} ({median(mean):.3f})"
