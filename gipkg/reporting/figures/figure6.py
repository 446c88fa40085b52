"""Figure 6: one shape, many cuts: turns about polar axes, opposite axes, and upright shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.images.cuts import TURNS, UPRIGHT_TURNS, standard_cuts, upright_cuts
from gipkg.images.lookup import PixelLookup, lookup
from gipkg.images.octahedron import sphere_to_square
from gipkg.images.padding import pad
from gipkg.reporting.cameras import Camera, principal_camera, standing_camera
from gipkg.reporting.colours import CUT, INK, sequential
from gipkg.reporting.cut_lines import cut_lines
from gipkg.reporting.figures.appearance import shaded, tip_colours, turned_as_seen
from gipkg.reporting.figures.layout import as_picture, page, panel, pixels
from gipkg.reporting.rendering import Lines, Surface, render
from gipkg.reporting.tips import AREA, limb_tips, vertex_shares

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIDE = 1.5
"""Width and height of a picture, in inches."""
AXES = ("+z", "-z", "+x", "-x", "+y", "-y")
"""Polar axes in the order of :func:`gipkg.images.cuts.standard_cuts`; z is to the eye."""
UP = "up"
"""Polar axis of a shape that stands upright."""


@dataclass(frozen=True, slots=True)
class View:
    """A row of the CSV: where a cut puts a part of a shape.

    Attributes
    ----------
    shape : str
        Its identifier.
    axis : str
        The polar axis, out of `AXES`, or `UP`.
    turn : float
        About it, in degrees.
    part : str
        ``tip 1`` for the end of the limb that reaches farthest from the middle, ``top`` for what
        is highest.
    u, v : float
        Place of the part's end in the image, from -1 to 1.
    pixels : int
        Of the image, whose nearest vertex is in the part.
    pixel_ratio : float
        Share of the pixels over the share of the surface that the part has.
    """

    shape: str
    axis: str
    turn: float
    part: str
    u: float
    v: float
    pixels: int
    pixel_ratio: float


@dataclass(frozen=True, slots=True)
class Cuts:
    """A shape under many cuts.

    Attributes
    ----------
    shape : str
        Its identifier.
    spherical_map : SphericalMap
    camera : Camera
        That the mesh is seen by.
    parts : mapping
        Name -> end and vertices of what is followed from image to image.
    colours : (V, 3) float64 array
    cuts : Rotation
    names : sequence of (str, float)
        Polar axis and turn of each cut.
    located : PixelLookup
        Of the images of all cuts.
    """

    shape: str
    spherical_map: SphericalMap
    camera: Camera
    parts: Mapping[str, tuple[int, NDArray[np.bool_]]]
    colours: NDArray[np.float64]
    cuts: Rotation
    names: Sequence[tuple[str, float]]
    located: PixelLookup

    @property
    def images(self) -> NDArray[np.float64]:
        """Colours as geometry images (K, 3, n, n), one a cut."""
        coloured = shaded(self.spherical_map.mesh, self.colours, self.camera)
        return self.located.render(coloured, np.float64)

    def views(self) -> list[View]:
        """Say in numbers where every cut puts the parts."""
        rows = []
        nearest = self.located.nearest
        shares = vertex_shares(self.spherical_map.mesh)
        for number, (axis, turn) in enumerate(self.names):
            for name, (end, inside) in self.parts.items():
                place = self.cuts[number].apply(self.spherical_map.sphere[end])
                u, v = sphere_to_square(place).tolist()
                seen = inside[nearest[number]]
                ratio = float(seen.mean() / shares[inside].sum())
                rows.append(View(self.shape, axis, turn, name, u, v, int(seen.sum()), ratio))
        return rows


def cut(shape: str, mesh: trimesh.Trimesh, sphere: NDArray[np.float64], size: int) -> Cuts:
    """Make the images of a shape with limbs for the 36 cuts of the paper.

    Parameters
    ----------
    shape : str
        Its identifier.
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices.
    sphere : (V, 3) float64 array
        Its map.
    size : int
        Pixels along a side of the images.
    """
    camera = principal_camera(np.asarray(mesh.vertices))
    spherical_map = turned_as_seen(SphericalMap(mesh, sphere), camera)
    cuts = standard_cuts()
    tips = limb_tips(mesh)
    parts = {
        f"tip {tip + 1}": (int(end), tips.region == tip) for tip, end in enumerate(tips.vertex)
    }
    names = [(axis, 360 / TURNS * turn) for axis in AXES for turn in range(TURNS)]
    located = lookup(spherical_map, size, cuts)
    return Cuts(shape, spherical_map, camera, parts, tip_colours(tips), cuts, names, located)


def cut_upright(shape: str, mesh: trimesh.Trimesh, sphere: NDArray[np.float64], size: int) -> Cuts:
    """Make the images of a shape whose z axis points up for its 12 turns.

    Parameters
    ----------
    shape, mesh, sphere, size
        As in :func:`cut`.
    """
    vertices, spherical_map = np.asarray(mesh.vertices), SphericalMap(mesh, sphere)
    cuts = upright_cuts(spherical_map)
    downward = np.argsort(-vertices[:, 2], kind="stable")
    top = np.zeros(len(vertices), dtype=bool)
    top[downward[np.cumsum(vertex_shares(mesh)[downward]) <= AREA]] = True
    names = [(UP, 360 / UPRIGHT_TURNS * turn) for turn in range(UPRIGHT_TURNS)]
    return Cuts(
        shape,
        spherical_map,
        standing_camera(vertices),
        {"top": (int(downward[0]), top)},
        sequential(vertices[:, 2]),
        cuts,
        names,
        lookup(spherical_map, size, cuts),
    )


def draw(limbed: Cuts, standing: Cuts) -> Figure:
    """Draw both shapes under their cuts.

    Parameters
    ----------
    limbed : Cuts
        From :func:`cut`: a row of turns for each of two polar axes, the second padded too, and the
        two ends of one axis.
    standing : Cuts
        From :func:`cut_upright`: all turns.
    """
    figure = page(_SIDE * (1 + TURNS) + 0.3, 6 * (_SIDE + 0.3))
    grid = figure.subplots(6, 1 + TURNS)
    images = limbed.images
    margin = images.shape[-1] // 2
    behind = replace(limbed.camera, towards_eye=-limbed.camera.towards_eye)
    for row, axis in ((0, "+z"), (1, "+x")):
        first = TURNS * AXES.index(axis)
        turns = range(first, first + TURNS)
        panel(grid[row, 0], _picture(limbed, first, behind), f"polar axis {axis}")
        _draw_turns(grid[row, 1:], images[turns], limbed.names[first:])
    _draw_turns(grid[2, 1:], pad(images[turns], margin), limbed.names[first:], margin)
    _say(grid[2, 0], f"the same,\npadded by {margin} pixels")
    _draw_opposite(grid[3], images[[TURNS * AXES.index(axis) for axis in ("+z", "-z")]])
    images = standing.images
    panel(grid[4, 0], _picture(standing, 0, standing.camera), "upright", standing.shape)
    _draw_turns(grid[4, 1:], images[:TURNS], standing.names)
    _say(grid[5, 0], "its other turns;\nlight is high")
    _draw_turns(grid[5, 1:], images[TURNS:], standing.names[TURNS:])
    return figure


def _picture(cuts: Cuts, number: int, camera: Camera) -> NDArray[np.uint8]:
    """Draw the mesh with a cut on it."""
    radius = 0.02 * camera.half_height
    lines = Lines(cut_lines(cuts.spherical_map, cuts.cuts[number]), CUT, radius)
    surface = Surface(cuts.spherical_map.mesh, cuts.colours)
    return render([surface, lines], camera, pixels(_SIDE, _SIDE))


def _draw_turns(
    row: Sequence[Axes],
    images: NDArray[np.float64],
    names: Sequence[tuple[str, float]],
    margin: int = 0,
) -> None:
    for axes, image, (_, turn) in zip(row, images, names, strict=False):
        panel(axes, as_picture(image), f"{turn:g}°")
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
