"""Figure 1: a shape as images of x, y, z and back, and what images say of one with holes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.descriptors.curvature import Curvature
from gipkg.descriptors.operators import Operators
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.images.lookup import lookup
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.cameras import Camera, principal_camera, standing_camera
from gipkg.reporting.colours import category, diverging, sequential
from gipkg.reporting.figures.appearance import facing
from gipkg.reporting.figures.layout import page, panel, pixels
from gipkg.reporting.rendering import NEUTRAL, render_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIDE = 2.2
"""Width and height of a picture, in inches."""
_ADDED = category(0)
"""Colour of what the surface stage added to close a hole or to cut a handle."""


@dataclass(frozen=True, slots=True)
class Pixel:
    """A row of the CSV: what is shown at a pixel of the images of the two shapes.

    Attributes
    ----------
    row, column : int
    x, y, z : float
        Of the first shape, in its own units.
    curvature_1, curvature_2 : float
        Principal curvatures of the shape with holes, sign(κ) log(1 + |κ|) on unit area.
    mask : float
        Its topological mask: 1 on the shape itself, 0 on what was added.
    """

    row: int
    column: int
    x: float
    y: float
    z: float
    curvature_1: float
    curvature_2: float
    mask: float


@dataclass(frozen=True, slots=True)
class Pictured:
    """A row of the second CSV: one of the two shapes.

    Attributes
    ----------
    shape : str
        Its identifier.
    vertices : int
    added_vertices, added_pixels : int
        Where the topological mask is below one half.
    hausdorff, mean : float
        From the shape to its reconstruction, as in
        :class:`gipkg.evaluation.surface_distance.SurfaceDistance`.
    """

    shape: str
    vertices: int
    added_vertices: int
    added_pixels: int
    hausdorff: float
    mean: float


@dataclass(frozen=True, slots=True)
class Imaged:
    """A shape, its geometry images, and the surface they give back.

    Attributes
    ----------
    mesh : trimesh.Trimesh
    mask : (V,) bool array
    camera : Camera
        That the mesh is seen by.
    positions : (3, n, n) float64 array
    curvatures : (2, n, n) float64 array
        The larger one first.
    topology : (n, n) float64 array
        The image of the mask.
    again : trimesh.Trimesh
        From the image of the positions.
    """

    mesh: trimesh.Trimesh
    mask: NDArray[np.bool_]
    camera: Camera
    positions: NDArray[np.float64]
    curvatures: NDArray[np.float64]
    topology: NDArray[np.float64]
    again: trimesh.Trimesh

    def row(self, shape: str) -> Pictured:
        """Measure the shape against its reconstruction."""
        distance = surface_distance(self.mesh, self.again)
        return Pictured(
            shape,
            len(self.mesh.vertices),
            int((~self.mask).sum()),
            int((self.topology < 0.5).sum()),
            distance.hausdorff,
            distance.mean,
        )


def image(
    mesh: trimesh.Trimesh,
    mask: NDArray[np.bool_],
    sphere: NDArray[np.float64],
    size: int,
    *,
    upright: bool = False,
) -> Imaged:
    """Make the geometry images of a shape, turned as it is seen.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices.
    mask : (V,) bool array
        True on the original surface.
    sphere : (V, 3) float64 array
        The map of the mesh.
    size : int
        Pixels along a side.
    upright : bool
        The z axis points up, and is to be seen so.
    """
    look_at = standing_camera if upright else principal_camera
    camera = look_at(np.asarray(mesh.vertices))
    spherical_map = SphericalMap(mesh, sphere)
    located = lookup(spherical_map, size, facing(spherical_map, camera))
    curvatures = Curvature.model_validate({}).describe(mesh, Operators(mesh))
    channels = np.column_stack([mesh.vertices, curvatures, mask])
    images = located.render(channels, np.float64)[0]
    return Imaged(mesh, mask, camera, images[:3], images[3:5], images[5], reconstruct(images[:3]))


def pixel_rows(whole: Imaged, holed: Imaged) -> list[Pixel]:
    """Say in numbers what every pixel shows."""
    size = whole.topology.shape[-1]
    shown = np.concatenate([whole.positions, holed.curvatures, holed.topology[None]])
    return [
        Pixel(*divmod(number, size), *values)
        for number, values in enumerate(shown.reshape(len(shown), -1).T.tolist())
    ]


def draw(whole: Imaged, holed: Imaged, shapes: Sequence[Pictured]) -> Figure:
    """Draw a row for each shape: mesh, three images, reconstruction.

    Parameters
    ----------
    whole, holed : Imaged
    shapes : sequence of two Pictured
        Their figures.
    """
    figure = page(5 * _SIDE + 0.2, 2 * (_SIDE + 0.6))
    above, below = figure.subplots(2, 5)
    _draw_surfaces(above, whole, shapes[0])
    _draw_surfaces(below, holed, shapes[1])
    reach = float(np.linalg.norm(np.ptp(whole.mesh.vertices, axis=0))) / 2
    middle = (whole.mesh.bounds.sum(axis=0) / 2)[:, None, None]
    for axes, values, name in zip(above[1:4], whole.positions - middle, "xyz", strict=True):
        panel(axes, diverging(values.ravel(), reach).reshape(*values.shape, 3), name)
    titles = ("larger principal curvature", "smaller principal curvature")
    for axes, values, title in zip(below[1:3], holed.curvatures, titles, strict=True):
        note = f"log, {values.min():.2g} (dark) to {values.max():.2g} (light)"
        panel(axes, sequential(values.ravel()).reshape(*values.shape, 3), title, note)
    panel(below[3], _marked(holed.topology[..., None]), "topological mask", "red was added")
    return figure


def _draw_surfaces(row: Sequence[Axes], shown: Imaged, figures: Pictured) -> None:
    square, size = pixels(_SIDE, _SIDE), shown.topology.shape[-1]
    note = f"{figures.shape}, {figures.vertices} vertices"
    colours = _marked(shown.mask[:, None].astype(np.float64))
    panel(
        row[0],
        render_mesh(shown.mesh, colours=colours, camera=shown.camera, size=square),
        "surface of genus 0",
        note,
    )
    masks = np.repeat(shown.topology[None], 3, axis=0)
    colours = _marked(np.asarray(reconstruct(masks).vertices)[:, :1])
    picture = render_mesh(shown.again, colours=colours, camera=shown.camera, size=square)
    note = f"{size} × {size}; farthest {figures.hausdorff:.1%} of the diagonal"
    panel(row[4], picture, "reconstruction", note)


def _marked(mask: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colour a mask (..., 1): plain where it is 1, the colour of what was added where it is 0."""
    return mask * np.array(NEUTRAL) + (1 - mask) * _ADDED
