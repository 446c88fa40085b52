"""Figure 7: what each method's geometry images keep of a shape, and where its areas go wrong."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.evaluation.histogram import LIMIT, bin_edges
from gipkg.evaluation.surface_distance import SurfaceDistance, surface_distance
from gipkg.images.lookup import geometry_image
from gipkg.images.reconstruct import reconstruct
from gipkg.images.sampling import Sampling
from gipkg.reporting.cameras import principal_camera
from gipkg.reporting.colours import INK, category
from gipkg.reporting.figures.layout import page, panel, pixels
from gipkg.reporting.rendering import render_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIDE = 1.6
"""Inches of a picture, along each side."""


@dataclass(frozen=True, slots=True)
class Reconstruction:
    """A shape as one method's geometry image gives it back.

    Attributes
    ----------
    picture : (H, W, 3) uint8 array
    distance : SurfaceDistance
        From the shape.
    """

    picture: NDArray[np.uint8]
    distance: SurfaceDistance


@dataclass(frozen=True, slots=True)
class Panel:
    """One shape under all methods.

    Attributes
    ----------
    id : str
    original : (H, W, 3) uint8 array
    reconstructions : mapping
        Method -> reconstruction; None where the method has no image of the shape.
    """

    id: str
    original: NDArray[np.uint8]
    reconstructions: Mapping[str, Reconstruction | None]


def reconstruct_panel(
    shape_id: str,
    mesh: trimesh.Trimesh,
    maps: Mapping[str, SphericalMap | None],
    size: int,
    sampling: Sampling = "equal-area",
) -> Panel:
    """Picture a shape and its reconstructions, all from the same side.

    Parameters
    ----------
    shape_id : str
    mesh : trimesh.Trimesh
        The surface.
    maps : mapping
        Method -> map of the surface, None where the method has none.
    size : int
        Of the geometry images, in pixels.
    sampling : {"equal-area", "authors"}
    """
    camera = principal_camera(np.asarray(mesh.vertices))
    extent = pixels(SIDE, SIDE)
    found: dict[str, Reconstruction | None] = {}
    for method, spherical_map in maps.items():
        again = _again(spherical_map, size, sampling)
        found[method] = None
        if again is not None:
            picture = render_mesh(again, camera=camera, size=extent)
            found[method] = Reconstruction(picture, surface_distance(mesh, again))
    return Panel(shape_id, render_mesh(mesh, camera=camera, size=extent), found)


def _again(
    spherical_map: SphericalMap | None, size: int, sampling: Sampling
) -> trimesh.Trimesh | None:
    """Go to the image and back; None where a map is missing or leaves pixels without a face."""
    if spherical_map is None:
        return None
    try:
        image = geometry_image(spherical_map, spherical_map.mesh.vertices, size, sampling=sampling)
    except UnsupportedMesh:
        return None
    return reconstruct(image)


def draw(
    panels: Sequence[Panel],
    histograms: Mapping[str, Mapping[str, NDArray[np.int64]]],
    variances: Mapping[tuple[str, str], float],
) -> Figure:
    """Lay the figure out: a column for each method, a row for each shape and each database.

    Parameters
    ----------
    panels : sequence of Panel
        Rows of reconstructions; all of the same methods.
    histograms : mapping
        Database -> method -> (BINS,) triangles, the rows below.
    variances : mapping
        (database, method) -> variance of δh·A.

    Returns
    -------
    Figure
    """
    methods = list(next(iter(histograms.values())))
    heights = [SIDE] * len(panels) + [0.8 * SIDE] * len(histograms)
    figure = page(SIDE * (1 + len(methods)), sum(heights) + 0.6)
    axes = figure.subplots(len(heights), 1 + len(methods), squeeze=False, height_ratios=heights)
    for line, shape in zip(axes, panels, strict=False):
        _draw_shape(line, shape)
    for line, (database, counts) in zip(axes[len(panels) :], histograms.items(), strict=True):
        _draw_label(line[0], database)
        for cell, method in zip(line[1:], methods, strict=True):
            _draw_histogram(cell, counts[method], variances[database, method])
        line[1].tick_params(labelleft=True)
    for cell, method in zip(axes[0, 1:], methods, strict=True):
        cell.set_title(method, fontsize=9, color=INK)
    return figure


def _draw_shape(line: Sequence[Axes], shape: Panel) -> None:
    panel(line[0], shape.original, note=shape.id)
    blank = np.full_like(shape.original, 255)
    for cell, again in zip(line[1:], shape.reconstructions.values(), strict=True):
        if again is None:
            panel(cell, blank, note="no image")
        else:
            panel(cell, again.picture, note=f"farthest {again.distance.hausdorff:.1%}")


def _draw_label(cell: Axes, database: str) -> None:
    cell.axis("off")
    lines = ["share of the triangles", "by δh·A, in areas of", "the mean triangle;"]
    lines += ["the outermost bins", "hold all beyond"]
    text = "\n".join((database, "", *lines))
    cell.text(0, 0.5, text, va="center", fontsize=8, color=INK)


def _draw_histogram(cell: Axes, counts: NDArray[np.int64], variance: float) -> None:
    shares = counts / max(counts.sum(), 1)
    cell.stairs(shares, bin_edges(), fill=True, color=category(1))
    cell.set_ylim(1e-6, 20)
    cell.set_yscale("log")
    cell.set_xlim(-LIMIT, LIMIT)
    cell.set_xticks([-1, 0, 1])
    cell.tick_params(labelsize=7, labelleft=False, colors=INK)
    cell.spines[["top", "right"]].set_visible(False)
    cell.text(
        0.98,
        0.95,
        f"variance {variance:.2g}",
        transform=cell.transAxes,
        fontsize=7,
        ha="right",
        va="top",
        color=INK,
    )


HISTOGRAM_HEADER = ("database", "parametrizer", "from", "to", "triangles")
SHAPE_HEADER = ("shape", "parametrizer", "hausdorff", "mean")


def histogram_rows(
    histograms: Mapping[str, Mapping[str, NDArray[np.int64]]],
) -> Iterator[Sequence[object]]:
    """Yield what the histograms show, a row for each bin (`HISTOGRAM_HEADER`)."""
    edges = [f"{edge:.4f}" for edge in bin_edges()]
    for database, methods in histograms.items():
        for method, counts in methods.items():
            for low, high, count in zip(edges[:-1], edges[1:], counts, strict=True):
                yield database, method, low, high, count


def shape_rows(panels: Sequence[Panel]) -> Iterator[Sequence[object]]:
    """Yield how far the pictured reconstructions are from their shapes (`SHAPE_HEADER`).

    A distance that is not there is empty.
    """
    for shape in panels:
        for method, again in shape.reconstructions.items():
            distance = again and again.distance
            figures = (distance.hausdorff, distance.mean) if distance else ()
            yield shape.id, method, *([f"{one:.6g}" for one in figures] or ["", ""])
