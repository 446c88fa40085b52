"""Figure 2: what maps leave of the tips of limbs, on the sphere, in the image and after it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.images.lookup import PixelLookup, lookup
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import INK
from gipkg.reporting.figures.appearance import (
    BACK,
    FRONT,
    RoundSphere,
    shaded,
    tip_colours,
    turned_as_seen,
)
from gipkg.reporting.figures.layout import as_picture, page, panel, pixels
from gipkg.reporting.parts import Part, measure
from gipkg.reporting.rendering import render_mesh
from gipkg.reporting.tips import AREA, Tips, limb_tips

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ASPECT = 0.8
"""Width over height of the pictures of the mesh."""
_ROW = 2.6
"""Height of a method's pictures, in inches."""


@dataclass(frozen=True, slots=True)
class Shown:
    """One method's map of the shape, turned as the mesh is seen, and what comes of it."""

    spherical_map: SphericalMap
    lookup: PixelLookup
    reconstruction: trimesh.Trimesh
    parts: tuple[Part, ...]


@dataclass(frozen=True, slots=True)
class Comparison:
    """A shape under several maps.

    Attributes
    ----------
    mesh : trimesh.Trimesh
    tips : Tips
    camera : Camera
        That mesh and reconstructions are seen by.
    methods : mapping
        Name -> its map.
    """

    mesh: trimesh.Trimesh
    tips: Tips
    camera: Camera
    methods: Mapping[str, Shown]

    @property
    def parts(self) -> tuple[Part, ...]:
        """The figures of all methods, in order."""
        return tuple(part for shown in self.methods.values() for part in shown.parts)


def compare(
    mesh: trimesh.Trimesh, spheres: Mapping[str, NDArray[np.float64]], size: int
) -> Comparison:
    """Make geometry images of a shape by several methods, surfaces from them, and measure.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices.
    spheres : mapping
        Name of a method -> its map, unit vectors (V, 3).
    size : int
        Pixels along a side of the geometry images.
    """
    camera = principal_camera(np.asarray(mesh.vertices), _ASPECT)
    tips = limb_tips(mesh)
    methods = {}
    for name, sphere in spheres.items():
        spherical_map = turned_as_seen(SphericalMap(mesh, sphere), camera)
        located = lookup(spherical_map, size, Rotation.identity())
        again = reconstruct(located.render(np.asarray(mesh.vertices), np.float64)[0])
        parts = measure(name, spherical_map, located, again, tips)
        methods[name] = Shown(spherical_map, located, again, parts)
    return Comparison(mesh, tips, camera, methods)


def draw(comparison: Comparison) -> Figure:
    """Draw the mesh, and a row for each method: sphere, geometry image, reconstruction."""
    mesh, camera = comparison.mesh, comparison.camera
    colours = tip_colours(comparison.tips)
    on_sphere = shaded(mesh, colours, camera)
    count = len(comparison.methods)
    figure = page(11, _ROW * count + 0.4)
    grid = figure.add_gridspec(count, 5, width_ratios=[1.1, 1, 1, 1, _ASPECT])
    limbs = len(comparison.tips.vertex)
    note = f"{len(mesh.vertices)} vertices; {limbs} tips,\n{AREA:.0%} of the area each"
    picture = render_mesh(mesh, colours=colours, camera=camera, size=_tall())
    panel(figure.add_subplot(grid[:, 0]), picture, "mesh", note)
    for row, (name, shown) in enumerate(comparison.methods.items()):
        axes = [figure.add_subplot(grid[row, column]) for column in range(1, 5)]
        _draw_method(axes, shown, camera, colours, on_sphere)
        axes[0].set_ylabel(name, fontsize=12, color=INK)
        if row == 0:
            size = shown.lookup.face.shape[-1]
            image = f"geometry image, {size} × {size}"
            titles = ("sphere", "from behind", image, "reconstruction from it")
            for one, title in zip(axes, titles, strict=True):
                one.set_title(title, fontsize=10, color=INK)
    return figure


def _draw_method(
    row: Sequence[Axes],
    shown: Shown,
    camera: Camera,
    colours: NDArray[np.float64],
    on_sphere: NDArray[np.float64],
) -> None:
    sphere = RoundSphere.of(shown.spherical_map)
    front, back, image, again = row
    whole, *tips = shown.parts
    ball, on_ball, square = sphere.mesh(), sphere.colours(on_sphere), pixels(_ROW, _ROW)
    for axes, side in ((front, FRONT), (back, BACK)):
        panel(axes, render_mesh(ball, colours=on_ball, camera=side, size=square))
    panel(image, as_picture(shown.lookup.render(on_sphere)[0]))
    if tips:
        ratios = [tip.area_ratio for tip in tips]
        front.set_xlabel(f"area ratio of the tips:\n{min(ratios):.2g} to {max(ratios):.2g}")
        seen = [tip.pixels for tip in tips]
        image.set_xlabel(f"pixels of the tips:\n{min(seen)} to {max(seen)}")
    from_image = reconstruct(shown.lookup.render(colours, np.float64)[0]).vertices
    picture = render_mesh(shown.reconstruction, colours=from_image, camera=camera, size=_tall())
    panel(
        again, picture, note=f"Hausdorff distance:\n{100 * whole.hausdorff:.2g} % of the diagonal"
    )


def _tall() -> tuple[int, int]:
    return pixels(_ASPECT * _ROW, _ROW)
