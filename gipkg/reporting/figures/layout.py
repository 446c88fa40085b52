"""Figures as pages of panels: pictures, curves and their titles, without a display."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gipkg.files import atomic
from gipkg.reporting.colours import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RESOLUTION = 200
"""Pixels an inch of a written figure."""


def page(width: float, height: float) -> Figure:
    """Begin a figure of that size in inches; it belongs to no window and no global state."""
    from matplotlib.figure import Figure

    return Figure((width, height), dpi=RESOLUTION, facecolor="white", layout="constrained")


def pixels(width: float, height: float) -> tuple[int, int]:
    """Return the size in pixels of a picture that fills so many inches of a page."""
    return round(width * RESOLUTION), round(height * RESOLUTION)


def panel(axes: Axes, picture: NDArray, title: str = "", note: str = "") -> None:
    """Show a picture as it is, with a title above and a note below.

    Parameters
    ----------
    axes : Axes
    picture : (H, W, 3) array
        Colours from 0 to 1, or bytes.
    title, note : str
    """
    axes.imshow(picture, interpolation="nearest")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=10, color=INK)
    axes.set_xlabel(note, fontsize=8, color=INK)


def as_picture(image: NDArray[np.floating]) -> NDArray[np.floating]:
    """Turn a geometry image of colours (3, n, n) into a picture (n, n, 3)."""
    return np.moveaxis(image, 0, -1).clip(0, 1)


def write_png(path: Path, figure: Figure) -> None:
    """Write a figure, atomically; the same figure, the same bytes."""
    with atomic(path) as stream:
        figure.savefig(stream, format="png", metadata={"Software": None})
