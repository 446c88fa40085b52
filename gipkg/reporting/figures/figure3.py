"""Figure 3: how the area distortion falls from iteration to iteration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Iteration, Parametrizer, SphericalMap
from gipkg.errors import InvalidParameterError
from gipkg.evaluation.distortion import Distortion, distortion
from gipkg.images.lookup import geometry_image
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import DIVERGING, INK, category, diverging
from gipkg.reporting.figures.appearance import FRONT, RoundSphere, facing
from gipkg.reporting.figures.layout import page, panel, pixels
from gipkg.reporting.rendering import render_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

_SIDE = 1.7
"""Width and height of a picture, in inches."""
_OCTAVES = 2
"""Area ratios from 1/4 to 4 have colours of their own."""


@dataclass(frozen=True, slots=True)
class Step:
    """A row of the CSV: a method after one iteration.

    Attributes
    ----------
    parametrizer : str
    iteration : int
    objective : float
        What the method lowers, in its own units.
    step : float
        Length of the step that led here, as a share of the one proposed.
    variance, face_std, vertex_std : float
        As in :class:`gipkg.evaluation.distortion.Distortion`.
    flips : int
    """

    parametrizer: str
    iteration: int
    objective: float
    step: float
    variance: float
    face_std: float
    vertex_std: float
    flips: int


@dataclass(frozen=True, slots=True)
class Progress:
    """A method at work on a shape: its figures at every iteration, its sphere at some.

    Attributes
    ----------
    steps : sequence of Step
    spheres : mapping
        Iteration -> unit vectors (V, 3), of those that are shown.
    """

    steps: Sequence[Step]
    spheres: Mapping[int, NDArray[np.float64]]


def record(name: str, parametrizer: Parametrizer, mesh: trimesh.Trimesh, shown: int) -> Progress:
    """Run an iterative method and keep what it did.

    Parameters
    ----------
    name : str
        Of the method.
    parametrizer : Parametrizer
        One that calls its callback.
    mesh : trimesh.Trimesh
        Closed genus-0 surface with V vertices.
    shown : int
        How many iterations keep their sphere: the first, the last, and between them such that
        each is about the same multiple of the one before.

    Raises
    ------
    InvalidParameterError
        The method never called back.
    """
    steps: list[Step] = []
    spheres: list[NDArray[np.float64]] = []

    def keep(iteration: Iteration) -> None:
        measured = distortion(SphericalMap(mesh, iteration.sphere))
        steps.append(_step(name, iteration, measured))
        spheres.append(iteration.sphere.copy())

    parametrizer.parametrize(mesh, callback=keep)
    if not steps:
        raise InvalidParameterError(
            f"{name} reports no iterations: name a parametrizer tagged iterative"
        )
    return Progress(steps, {index: spheres[index] for index in _spread(len(steps) - 1, shown)})


def _step(name: str, iteration: Iteration, measured: Distortion) -> Step:
    return Step(
        name,
        iteration.number,
        float(iteration.objective),
        float(iteration.step),
        measured.variance,
        measured.face_std,
        measured.vertex_std,
        measured.flips,
    )


def _spread(last: int, count: int) -> list[int]:
    """Choose up to `count` of the numbers 0 to `last`, each a multiple of the one before."""
    if last < count:
        return list(range(last + 1))
    return [0, *np.unique(np.rint(np.geomspace(last, 1, count - 1)).astype(int)).tolist()]


def draw(mesh: trimesh.Trimesh, methods: Sequence[Progress], size: int) -> Figure:
    """Draw two rows for each method, spheres and reconstructions, and the curves of all.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        That the methods were recorded on.
    methods : sequence of Progress
    size : int
        Pixels along a side of the geometry images that are reconstructed from.
    """
    columns = max(len(progress.spheres) for progress in methods)
    figure = page(_SIDE * columns + 4, 2 * (_SIDE + 0.3) * len(methods))
    halves = figure.subfigures(1, 2, squeeze=False, width_ratios=[_SIDE * columns, 4])
    grid = halves[0, 0].subplots(2 * len(methods), columns, squeeze=False)
    camera = principal_camera(np.asarray(mesh.vertices))
    for number, progress in enumerate(methods):
        spheres, shapes = grid[2 * number : 2 * number + 2]
        _draw_method(spheres, shapes, mesh, progress, size, camera)
    _draw_curves(halves[0, 1], methods)
    return figure


def _draw_method(
    spheres: Sequence[Axes],
    shapes: Sequence[Axes],
    mesh: trimesh.Trimesh,
    progress: Progress,
    size: int,
    camera: Camera,
) -> None:
    turn = facing(SphericalMap(mesh, list(progress.spheres.values())[-1]), camera)
    for axes in (*spheres[len(progress.spheres) :], *shapes[len(progress.spheres) :]):
        axes.set_axis_off()
    for above, below, index in zip(spheres, shapes, progress.spheres, strict=False):
        spherical_map = SphericalMap(mesh, turn.apply(progress.spheres[index]))
        step = progress.steps[index]
        note = f"std(r − 1) = {step.face_std:.2g}"
        panel(above, _sphere(spherical_map), f"iteration {step.iteration}", note)
        again = reconstruct(geometry_image(spherical_map, np.asarray(mesh.vertices), size))
        panel(below, render_mesh(again, camera=camera, size=pixels(_SIDE, _SIDE)))
    spheres[0].set_ylabel(progress.steps[0].parametrizer, fontsize=11, color=INK)


def _sphere(spherical_map: SphericalMap) -> NDArray[np.uint8]:
    """Draw a sphere, every face in the colour of its area ratio."""
    measured = distortion(spherical_map)
    # A flipped face has no logarithm; it takes the colour of the smallest ratio.
    ratio = np.maximum(measured.spherical_areas / measured.mesh_areas, 2.0**-_OCTAVES)
    sphere = RoundSphere.of(spherical_map)
    colours = sphere.face_colours(diverging(np.log2(ratio), _OCTAVES))
    return render_mesh(sphere.mesh(), colours=colours, camera=FRONT, size=pixels(_SIDE, _SIDE))


def _draw_curves(figure: SubFigure, methods: Sequence[Progress]) -> None:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    axes = figure.subplots()
    for number, progress in enumerate(methods):
        iterations = [step.iteration for step in progress.steps]
        variances = [step.variance for step in progress.steps]
        name = progress.steps[0].parametrizer
        axes.plot(iterations, variances, color=category(number), label=name)
    axes.set_yscale("log")
    axes.set_xscale("symlog", linthresh=1)
    axes.set_xlim(left=0)
    axes.set_xlabel("iteration")
    axes.set_ylabel("variance of δh·A over the faces")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False)
    scale = ScalarMappable(Normalize(-_OCTAVES, _OCTAVES), DIVERGING)
    ticks = np.arange(-_OCTAVES, _OCTAVES + 1)
    bar = figure.colorbar(scale, ax=axes, location="bottom", ticks=ticks, aspect=30)
    bar.ax.set_xticklabels([f"1/{2**-k}" if k < 0 else str(2**k) for k in ticks.tolist()])
    bar.set_label("area ratio r, sphere / mesh")
