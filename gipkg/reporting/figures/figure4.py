"""Figure 4: the flow that restores areas, and the way from the sphere to the image."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.images.lookup import geometry_image
from gipkg.images.octahedron import pixel_directions, sphere_to_square
from gipkg.parametrizers.flow.linear_elements import LinearElements
from gipkg.parametrizers.flow.poisson import Poisson
from gipkg.parametrizers.sphere.areas import signed_spherical_areas
from gipkg.reporting import octahedron
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import INK, category, sequential
from gipkg.reporting.figures.appearance import (
    RoundSphere,
    shaded,
    sphere_camera,
    turned_as_seen,
)
from gipkg.reporting.figures.layout import as_picture, page, panel, pixels
from gipkg.reporting.rendering import NEUTRAL, Arrows, Lines, Part, Surface, render
from gipkg.reporting.tips import limb_tips
from gipkg.surfaces.areas import at_vertices

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIDE = 3.2
"""Width and height of a picture, in inches."""
_TIP = category(6)
"""Colour of the tips of limbs, unlike those of the four edges."""
_NEARER = 0.25
"""Share of the first picture that the enlarged one shows."""
_FROM_BEHIND = sphere_camera([0.3, -0.35, -0.9])
"""All four edges that are cut are seen."""


@dataclass(frozen=True, slots=True)
class Flow:
    """What the paper's method does to a map first (Section 3, steps 1 and 2).

    Attributes
    ----------
    distortion : (V,) float64 array
        δh: sphere area over mesh area, less 1, of each vertex (a third of its faces).
    potential : (V,) float64 array
        g of mean zero, where -∇²g = δh on the mesh scaled to the area 4π.
    gradient : (V, 3) float64 array
        The vertices move along it on the mesh, to what is too large on the sphere.
    """

    distortion: NDArray[np.float64]
    potential: NDArray[np.float64]
    gradient: NDArray[np.float64]


def flow(start: SphericalMap) -> Flow:
    """Solve for the flow that restores the areas of a map.

    Parameters
    ----------
    start : SphericalMap
        Map of a closed genus-0 mesh with V vertices.
    """
    faces = np.asarray(start.mesh.faces, dtype=np.int64)
    vertices = np.asarray(start.mesh.vertices, dtype=np.float64)
    elements = LinearElements(vertices * np.sqrt(4 * np.pi / start.mesh.area), faces)
    on_sphere = at_vertices(signed_spherical_areas(start.sphere, faces), faces, len(vertices))
    on_mesh = at_vertices(elements.areas, faces, len(vertices))
    potential = Poisson(elements.stiffness()).solve(on_sphere - on_mesh)
    return Flow(on_sphere / on_mesh - 1, potential, elements.vertex_gradients(potential))


@dataclass(frozen=True, slots=True)
class Row:
    """A row of the CSV: a vertex in the flow of one map, and on the square by another.

    Attributes
    ----------
    vertex : int
    distortion, potential, gradient_x, gradient_y, gradient_z : float
        As in :class:`Flow`.
    u, v : float
        Where the vertex is in the geometry image, -1 to 1 from left to right and upward.
    """

    vertex: int
    distortion: float
    potential: float
    gradient_x: float
    gradient_y: float
    gradient_z: float
    u: float
    v: float


@dataclass(frozen=True, slots=True)
class Explanation:
    """What the figure shows.

    Attributes
    ----------
    flow : Flow
        Of the one map.
    unfolded : SphericalMap
        The other, turned as the mesh is seen.
    camera : Camera
        That the mesh is seen by.
    """

    flow: Flow
    unfolded: SphericalMap
    camera: Camera

    def rows(self) -> list[Row]:
        """Say in numbers what is shown of each vertex."""
        figures = np.column_stack(
            [
                self.flow.distortion,
                self.flow.potential,
                self.flow.gradient,
                sphere_to_square(self.unfolded.sphere),
            ]
        )
        return [Row(vertex, *line) for vertex, line in enumerate(figures.tolist())]


def explain(start: SphericalMap, unfolded: SphericalMap) -> Explanation:
    """Compute the flow that restores the areas of one map, and turn another to be unfolded.

    Parameters
    ----------
    start, unfolded : SphericalMap
        Of the same closed genus-0 mesh with V vertices.
    """
    camera = principal_camera(np.asarray(unfolded.mesh.vertices))
    return Explanation(flow(start), turned_as_seen(unfolded, camera), camera)


def draw(explanation: Explanation, size: int) -> Figure:
    """Draw the flow above, and the unfolding to an image of `size` pixels a side below."""
    figure = page(3 * _SIDE + 0.6, 2 * _SIDE + 1.2)
    above, below = figure.subplots(2, 3)
    _draw_flow(above, explanation)
    _draw_unfolding(below, explanation, size)
    return figure


def _draw_flow(row: Sequence[Axes], explanation: Explanation) -> None:
    mesh, camera, restoring = explanation.unfolded.mesh, explanation.camera, explanation.flow
    strongest = np.linalg.norm(restoring.gradient, axis=1).argmax()
    near = replace(
        camera,
        centre=np.asarray(mesh.vertices)[strongest],
        half_height=_NEARER * camera.half_height,
    )
    potential, plain = Surface(mesh, sequential(restoring.potential)), Surface(mesh)
    low, high = restoring.potential.min(), restoring.potential.max()
    panels: list[tuple[list[Part], Camera, str, str]] = [
        ([potential], camera, "potential g, −∇²g = δh", f"{low:.2g} (dark) to {high:.2g} (light)"),
        (
            [plain, _arrows(mesh, restoring, camera)],
            camera,
            "the flow ∇g",
            "vertices move along it; lengths are as √|∇g|",
        ),
        ([plain, _arrows(mesh, restoring, near)], near, "nearer", "where it is strongest"),
    ]
    for axes, (scene, seen_by, title, note) in zip(row, panels, strict=True):
        panel(axes, render(scene, seen_by, pixels(_SIDE, _SIDE)), title, note)


def _arrows(mesh: trimesh.Trimesh, restoring: Flow, camera: Camera) -> Arrows:
    """Put arrows all over what a camera sees, none longer than a share of the picture."""
    vertices = np.asarray(mesh.vertices)
    spacing = 0.09 * camera.half_height
    cells = np.floor(vertices / spacing).astype(np.int64)
    _, chosen = np.unique(cells, axis=0, return_index=True)
    gradient = restoring.gradient[chosen]
    strength = np.linalg.norm(gradient, axis=1, keepdims=True)
    # Lengths are square roots: the flow in a limb is many times that on the trunk.
    lengths = 0.2 * camera.half_height * np.sqrt(strength / strength.max())
    vectors = lengths * np.divide(gradient, strength, where=strength > 0, out=gradient * 0)
    lifted = vertices[chosen] + 0.1 * spacing * np.asarray(mesh.vertex_normals)[chosen]
    return Arrows(lifted, vectors, category(1))


def _draw_unfolding(row: Sequence[Axes], explanation: Explanation, size: int) -> None:
    unfolded = explanation.unfolded
    mesh = unfolded.mesh
    is_tip = limb_tips(mesh).region >= 0
    colours = shaded(mesh, np.where(is_tip[:, None], _TIP, NEUTRAL), explanation.camera)
    grid = RoundSphere.of(unfolded)
    on_grid = grid.colours(colours)
    corners = octahedron.sphere_to_octahedron(pixel_directions(grid.SIZE))
    sphere: list[Part] = [Surface(grid.mesh(), on_grid), *_edge_lines(on_sphere=True)]
    solid: list[Part] = [Surface(grid.mesh(corners), on_grid), *_edge_lines(on_sphere=False)]
    note = "seen from behind, where it is cut"
    for axes, scene, title in ((row[0], sphere, "sphere"), (row[1], solid, "octahedron")):
        panel(axes, render(scene, _FROM_BEHIND, pixels(_SIDE, _SIDE)), title, note)
    note = "each side is one cut edge, folded at its middle"
    image = as_picture(geometry_image(unfolded, colours, size))
    panel(row[2], image, f"geometry image, {size} × {size}", note)
    _draw_edges(row[2], size)


def _edge_lines(on_sphere: bool) -> list[Lines]:
    lines = []
    for number, edge in enumerate(octahedron.edges()):
        path = 1.003 * (edge.arc if on_sphere else edge.chord)
        colour, radius = (category(number), 0.02) if edge.cut else (np.array(INK), 0.008)
        lines.append(Lines([path], colour, radius))
    return lines


def _draw_edges(axes: Axes, size: int) -> None:
    """Draw the edges over a geometry image; arrows on its sides point to the south pole."""
    for number, edge in enumerate(octahedron.edges()):
        for segment in edge.on_square:
            columns = (size - 1) * (segment[:, 0] + 1) / 2
            rows = (size - 1) * (1 - segment[:, 1]) / 2
            if edge.cut:
                style = {"color": category(number), "lw": 4, "shrinkA": 0, "shrinkB": 0}
                axes.annotate(
                    "",
                    (columns[1], rows[1]),
                    (columns[0], rows[0]),
                    arrowprops={"arrowstyle": "-|>", **style},
                )
            else:
                axes.plot(columns, rows, color=INK, lw=0.8)
