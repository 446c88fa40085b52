"""Figure 6: one shape, many cuts: turns about polar axes, and the two ends of one axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.images import PixelLookup, lookup, pad, standard_cuts
from gipkg.images.cuts import TURNS
from gipkg.images.octahedron import sphere_to_square
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import CUT, INK
from gipkg.reporting.cut_lines import cut_lines
from gipkg.reporting.figures.appearance import facing, shaded, tip_colours
from gipkg.reporting.figures.layout import as_picture, page, panel, pixels
from gipkg.reporting.rendering import Lines, Surface, render
from gipkg.reporting.tips import Tips, limb_tips

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIDE = 1.5
"""Width and height of a picture, in inches."""
AXES = ("+z", "-z", "+x", "-x", "+y", "-y")
"""Polar axes in the order of :func:`gipkg.images.standard_cuts`; z is to the eye."""


@dataclass(frozen=True, slots=True)
class View:
    """A row of the CSV: where a cut puts a part of the shape.

    Attributes
    ----------
    axis : str
        The polar axis, out of `AXES`.
    turn : float
        About it, in degrees.
    part : str
        ``tip 1`` for the end of the limb that reaches farthest from the middle.
    u, v : float
        Place of the part's end in the image, from -1 to 1.
    pixels : int
        Of the image, whose nearest vertex is in the part.
    """

    axis: str
    turn: float
    part: str
    u: float
    v: float
    pixels: int


@dataclass(frozen=True, slots=True)
class Cuts:
    """A shape with limbs under all cuts.

    Attributes
    ----------
    spherical_map : SphericalMap
        Turned as the mesh is seen.
    camera : Camera
        That the mesh is seen by.
    tips : Tips
    located : PixelLookup
        Of the images of all cuts.
    """

    spherical_map: SphericalMap
    camera: Camera
    tips: Tips
    located: PixelLookup

    def views(self) -> list[View]:
        """Say in numbers where every cut puts the tips."""
        rows = []
        nearest = self.located.faces[self.located.face]
        nearest = np.take_along_axis(nearest, self.located.weights.argmax(-1)[..., None], -1)
        for number, cut in enumerate(standard_cuts()):
            places = sphere_to_square(cut.apply(self.spherical_map.sphere[self.tips.vertex]))
            region = self.tips.region[nearest[number]]
            for tip, (u, v) in enumerate(places.tolist()):
                seen = int((region == tip).sum())
                axis, turn = AXES[number // TURNS], 360 / TURNS * (number % TURNS)
                rows.append(View(axis, turn, f"tip {tip + 1}", u, v, seen))
        return rows


def cut(mesh: trimesh.Trimesh, sphere: NDArray[np.float64], size: int) -> Cuts:
    """Make the images of a mapped shape for all cuts of the paper.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices.
    sphere : (V, 3) float64 array
        Its map.
    size : int
        Pixels along a side of the images.
    """
    camera = principal_camera(np.asarray(mesh.vertices))
    turn = facing(SphericalMap(mesh, sphere), camera)
    spherical_map = SphericalMap(mesh, turn.apply(sphere))
    return Cuts(
        spherical_map, camera, limb_tips(mesh), lookup(spherical_map, size, standard_cuts())
    )


def draw(cuts: Cuts) -> Figure:
    """Draw a row of turns for each of two polar axes, the second padded, and opposite axes."""
    figure = page(_SIDE * (1 + TURNS) + 0.3, 4 * (_SIDE + 0.3))
    grid = figure.subplots(4, 1 + TURNS)
    mesh = cuts.spherical_map.mesh
    colours = tip_colours(cuts.tips)
    images = cuts.located.render(shaded(mesh, colours, cuts.camera), np.float64)
    size = images.shape[-1]
    margin = size // 2
    for row, axis in ((0, "+z"), (1, "+x")):
        first = TURNS * AXES.index(axis)
        panel(grid[row, 0], _picture(cuts, colours, first), f"polar axis {axis}")
        _draw_turns(grid[row, 1:], images[first : first + TURNS])
    _draw_turns(grid[2, 1:], pad(images[first : first + TURNS], margin), margin)
    _say(grid[2, 0], f"the same,\npadded by {margin} pixels")
    _draw_opposite(grid[3], images[[TURNS * AXES.index(axis) for axis in ("+z", "-z")]])
    return figure


def _picture(cuts: Cuts, colours: NDArray[np.float64], number: int) -> NDArray[np.uint8]:
    """Draw the mesh with a cut on it, from where the cut is seen best: the south pole."""
    mesh, rotation = cuts.spherical_map.mesh, standard_cuts()[number]
    radius = 0.02 * cuts.camera.half_height
    lines = Lines(cut_lines(cuts.spherical_map, rotation), CUT, radius)
    seen = Camera(
        cuts.camera.centre, -cuts.camera.towards_eye, cuts.camera.up, cuts.camera.half_height
    )
    return render([Surface(mesh, colours), lines], seen, pixels(_SIDE, _SIDE))


def _draw_turns(row: Sequence[Axes], images: NDArray[np.float64], margin: int = 0) -> None:
    for number, (axes, image) in enumerate(zip(row, images, strict=True)):
        panel(axes, as_picture(image), f"{360 // TURNS * number}°")
        if margin:
            _frame(axes, image.shape[-1], margin)


def _draw_opposite(row: Sequence[Axes], images: NDArray[np.float64]) -> None:
    """Show the images of the two ends of an axis, and both continued to 3 x 3."""
    size = images.shape[-1]
    _say(row[0], "opposite axes,\nand 3 × 3 of each")
    for axes, image, axis in zip(row[1:3], images, ("+z", "−z"), strict=True):
        panel(axes, as_picture(image), f"polar axis {axis}")
    for axes, image, axis in zip(row[3:5], images, ("+z", "−z"), strict=True):
        panel(axes, as_picture(pad(image, size - 1)), f"{axis}, 3 × 3")
        _frame(axes, 3 * size - 2, size - 1)
    for axes in row[5:]:
        axes.set_axis_off()


def _frame(axes: Axes, size: int, margin: int) -> None:
    """Frame the image within its padding."""
    low, high = margin - 0.5, size - margin - 0.5
    axes.plot([low, high, high, low, low], [low, low, high, high, low], color=INK, lw=1)


def _say(axes: Axes, text: str) -> None:
    axes.set_axis_off()
    axes.text(0.5, 0.5, text, ha="center", va="center", fontsize=9, color=INK)
