"""Pictures of surfaces, drawn off-screen: nothing is opened and no display is needed."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from ctypes.util import find_library
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

from gipkg.errors import RenderingError
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import as_bytes

if TYPE_CHECKING:
    import pyvista

NEUTRAL = (0.78, 0.80, 0.83)
"""Colour of a surface that shows nothing but its form."""

_OVERSAMPLING = 2
"""Pixels drawn for one pixel of the picture, along each side: smooth edges on any driver."""

_MATT: dict[str, Any] = {"ambient": 0.55, "diffuse": 0.5, "specular": 0.0}
"""Light enough for colours to be read, shadow enough for the form."""


@dataclass(frozen=True)
class Surface:
    """A mesh and its colours.

    Attributes
    ----------
    mesh : trimesh.Trimesh
        V vertices and F faces.
    colours : (3,), (V, 3) or (F, 3) array_like
        Red, green and blue from 0 to 1: of everything, of each vertex, or of each face.
    edges : bool
        Whether the edges of the mesh are drawn.
    smooth : bool
        Whether light varies within a face.
    """

    mesh: trimesh.Trimesh
    colours: ArrayLike = NEUTRAL
    edges: bool = False
    smooth: bool = True


@dataclass(frozen=True)
class Lines:
    """Polylines in space, drawn as tubes.

    Attributes
    ----------
    paths : sequence of (N, 3) arrays
    colour : (3,) array_like
        Red, green and blue from 0 to 1.
    radius : float
        Of the tubes, in the surface's units.
    """

    paths: Iterable[NDArray[np.floating]]
    colour: ArrayLike
    radius: float


@dataclass(frozen=True)
class Arrows:
    """Vectors at points in space.

    Attributes
    ----------
    points, vectors : (N, 3) arrays
        Where each arrow begins, and its direction and length.
    colour : (3,) array_like
        Red, green and blue from 0 to 1.
    """

    points: NDArray[np.floating]
    vectors: NDArray[np.floating]
    colour: ArrayLike


Part = Surface | Lines | Arrows


def render_mesh(
    mesh: trimesh.Trimesh,
    *,
    colours: ArrayLike = NEUTRAL,
    camera: Camera | None = None,
    size: tuple[int, int] = (600, 600),
    edges: bool = False,
    smooth: bool = True,
) -> NDArray[np.uint8]:
    """Draw one mesh on white.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        V vertices and F faces.
    colours : (3,), (V, 3) or (F, 3) array_like
        Red, green and blue from 0 to 1: of everything, of each vertex, or of each face.
    camera : Camera, optional
        By default the mesh fills the picture, seen along its thinnest principal axis.
    size : tuple of two ints
        Width and height in pixels.
    edges, smooth : bool
        Draw the edges; let light vary within a face.

    Returns
    -------
    (height, width, 3) uint8 array

    Raises
    ------
    RenderingError
        This machine cannot draw off-screen; the message says what to install.
    ValueError
        The colours of a surface are neither one, nor one a vertex, nor one a face.
    """
    if camera is None:
        camera = principal_camera(np.asarray(mesh.vertices), size[0] / size[1])
    return render([Surface(mesh, colours, edges, smooth)], camera, size)


def render(
    parts: Iterable[Part], camera: Camera, size: tuple[int, int] = (600, 600)
) -> NDArray[np.uint8]:
    """Draw surfaces, lines and arrows together on white.

    Parameters
    ----------
    parts : iterable of Surface, Lines or Arrows
    camera : Camera
    size : tuple of two ints
        Width and height in pixels.

    Returns
    -------
    (height, width, 3) uint8 array

    Raises
    ------
    RenderingError
        This machine cannot draw off-screen; the message says what to install.
    ValueError
        The colours of a surface are neither one, nor one a vertex, nor one a face.
    """
    pv = _pyvista()
    large = [_OVERSAMPLING * length for length in size]
    plotter = pv.Plotter(off_screen=True, window_size=large, lighting="none")
    try:
        plotter.set_background("white")
        _light(plotter, pv)
        for part in parts:
            _add(plotter, pv, part)
        _aim(plotter, camera)
        drawn = plotter.screenshot(return_img=True)
    finally:
        plotter.close()
    width, height = size
    blocks = np.asarray(drawn)[..., :3].reshape(height, _OVERSAMPLING, width, _OVERSAMPLING, 3)
    return np.rint(blocks.mean(axis=(1, 3))).astype(np.uint8)


def _add(plotter: pyvista.Plotter, pv: ModuleType, part: Part) -> None:
    match part:
        case Surface():
            _add_surface(plotter, pv, part)
        case Lines():
            for path in part.paths:
                tube = pv.lines_from_points(np.asarray(path)).tube(radius=part.radius, n_sides=16)
                plotter.add_mesh(tube, color=_rgb(part.colour), **_MATT)
        case Arrows():
            cloud = pv.PolyData(np.asarray(part.points, dtype=np.float64))
            cloud["vectors"] = np.asarray(part.vectors, dtype=np.float64)
            arrow = pv.Arrow(tip_length=0.4, tip_radius=0.16, shaft_radius=0.05)
            glyphs = cloud.glyph(orient="vectors", scale="vectors", geom=arrow)
            plotter.add_mesh(glyphs, color=_rgb(part.colour), **_MATT)


def _add_surface(plotter: pyvista.Plotter, pv: ModuleType, part: Surface) -> None:
    mesh = part.mesh
    surface = pv.PolyData.from_regular_faces(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    options: dict[str, Any] = {"show_edges": part.edges, "edge_color": (0.25, 0.25, 0.25), **_MATT}
    colours = np.asarray(part.colours, dtype=np.float64)
    if colours.ndim == 1:
        options["color"] = _rgb(colours)
    else:
        data = {len(mesh.vertices): surface.point_data, len(mesh.faces): surface.cell_data}
        if colours.shape[1:] != (3,) or len(colours) not in data:
            raise ValueError(
                f"colours are {colours.shape}, they must be (3,), ({len(mesh.vertices)}, 3) for "
                f"the vertices or ({len(mesh.faces)}, 3) for the faces"
            )
        data[len(colours)]["colours"] = as_bytes(colours)
        options |= {"scalars": "colours", "rgb": True}
    if part.smooth:
        # VTK's own smooth shading may turn or split vertices; ours are those of the mesh.
        surface.point_data.active_normals = np.asarray(mesh.vertex_normals)
    plotter.add_mesh(surface, interpolation="Phong" if part.smooth else "Flat", **options)


def _light(plotter: pyvista.Plotter, pv: ModuleType) -> None:
    """Light the scene from above the eye's left, and a little from its right."""
    for position, intensity in (((-0.5, 0.8, 1.0), 0.8), ((1.0, -0.2, 0.6), 0.25)):
        plotter.add_light(
            pv.Light(position=position, intensity=intensity, light_type="camera light")
        )


def _aim(plotter: pyvista.Plotter, camera: Camera) -> None:
    view = plotter.camera
    view.enable_parallel_projection()
    view.focal_point = camera.centre
    view.position = camera.centre + 10 * camera.half_height * camera.towards_eye
    view.up = camera.up
    view.parallel_scale = camera.half_height
    plotter.reset_camera_clipping_range()


def _rgb(colour: ArrayLike) -> tuple[float, ...]:
    return tuple(np.asarray(colour, dtype=np.float64))


@cache
def _pyvista() -> ModuleType:
    """Import PyVista, and see that VTK finds what it draws with: without, it would crash."""
    if sys.platform == "linux":
        # EGL needs no display. VTK would try X first, and hang or warn where DISPLAY is stale.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    try:
        import pyvista
    except ImportError as error:
        raise RenderingError(
            f"figures need PyVista, which cannot be imported ({error}): "
            'pip install "gipkg[figures]"'
        ) from error
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers the kinds of windows
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    last_resort = vtkRenderWindow().GetClassName() == "vtkOSOpenGLRenderWindow"
    if last_resort and find_library("OSMesa") is None:
        raise RenderingError(
            "this machine has no OpenGL library that draws without a display: install EGL "
            "with its driver (Debian and Ubuntu: apt-get install libegl1 libgl1-mesa-dri; "
            "Fedora: dnf install mesa-libEGL mesa-dri-drivers)"
        )
    return pyvista
