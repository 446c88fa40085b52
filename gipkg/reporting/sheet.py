"""A sheet of small pictures of meshes, each with what is to be said of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from gipkg.errors import MeshFormatError
from gipkg.formats.mesh_reading import read_mesh
from gipkg.reporting.figures.layout import page, panel, pixels
from gipkg.reporting.pictures import Picture, of_mesh

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = 4
_SIDE = 1.8
"""Width and height of a picture, in inches."""
_LONGEST = 32
"""Letters of a note that fit under a picture."""


@dataclass(frozen=True, slots=True)
class Shown:
    """A mesh on the sheet.

    Attributes
    ----------
    path : Path
    title, note : str
        Above and below its picture.
    """

    path: Path
    title: str
    note: str


def draw(meshes: Sequence[Shown]) -> Figure:
    """Draw meshes in rows, in their order; one that is no longer there leaves its place empty."""
    rows = -(-len(meshes) // COLUMNS)
    figure = page(COLUMNS * (_SIDE + 0.1), rows * (_SIDE + 0.5))
    places = figure.subplots(rows, COLUMNS, squeeze=False).ravel()
    for axes, shown in zip(places, meshes, strict=False):
        panel(axes, _picture(shown.path), shown.title, _plain(shown.note))
    for axes in places[len(meshes) :]:
        axes.set_axis_off()
    return figure


def _picture(path: Path) -> Picture:
    size, _ = pixels(_SIDE, _SIDE)
    try:
        return of_mesh(read_mesh(path), size)
    except MeshFormatError:
        return np.full((size, size, 3), 255, np.uint8)


def _plain(text: str) -> str:
    """Shorten a name from its beginning, and keep Matplotlib from reading formulas in it."""
    shortened = text if len(text) <= _LONGEST else "…" + text[1 - _LONGEST :]
    return shortened.replace("$", r"\$")
