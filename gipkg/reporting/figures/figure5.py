"""Figure 5: what a turn and a bend do to images of coordinates and of HKS, and padding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import Parametrizer, SphericalMap
from gipkg.descriptors.hks import HeatKernelSignature
from gipkg.descriptors.operators import Operators
from gipkg.images.lookup import geometry_image
from gipkg.images.padding import pad
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.articulation import bend, stretching
from gipkg.reporting.cameras import Camera, principal_camera
from gipkg.reporting.colours import CUT, INK, category, diverging, sequential
from gipkg.reporting.cut_lines import cut_lines
from gipkg.reporting.figures.appearance import as_seen, facing
from gipkg.reporting.figures.layout import page, panel, pixels
from gipkg.reporting.rendering import Lines, Surface, render
from gipkg.reporting.tips import vertex_shares

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIDE = 2.1
"""Width and height of a picture, in inches."""

_BEND = 1.0
"""Radians that the joints of the limbs are bent by."""
_TIMES = 5
"""Of the heat kernel signature; the figure shows the one in the middle."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A shape in one position, its map and its geometry images.

    Attributes
    ----------
    mesh : trimesh.Trimesh
        V vertices, the middle of the surface at the origin; x to the right of the picture, y
        upward and z to the eye.
    sphere : (V, 3) float64 array
    hks : (V,) float64 array
        Logarithm of the heat kernel signature.
    images : (4, n, n) float64 array
        Of x, y, z and the signature.
    """

    mesh: trimesh.Trimesh
    sphere: NDArray[np.float64]
    hks: NDArray[np.float64]
    images: NDArray[np.float64]

    @property
    def spherical_map(self) -> SphericalMap:
        """The mesh with its sphere."""
        return SphericalMap(self.mesh, self.sphere)


@dataclass(frozen=True, slots=True)
class Claim:
    """A row of the CSV: what the figure shows, as a number.

    Attributes
    ----------
    claim : str
    value : float
    """

    claim: str
    value: float


@dataclass(frozen=True, slots=True)
class Properties:
    """The three positions of a shape: as it is, after a half turn, with bent limbs."""

    original: Pose
    turned: Pose
    bent: Pose

    def claims(self) -> list[Claim]:
        """Say in numbers what the figure is there to show."""
        before, turned = self.original, self.turned
        flipped = before.images[:, ::-1, ::-1]
        moved = np.linalg.norm(self.bent.mesh.vertices - before.mesh.vertices, axis=1)
        diagonal = np.linalg.norm(np.ptp(before.mesh.vertices, axis=0))
        depths = (pose.mesh.vertices[:, 2] for pose in (before, self.bent))
        last = before.images.shape[-1] - 1
        padded = pad(before.images[:3], last)
        inside, across = _steps(before.images[:3]), _steps(padded)
        return [
            Claim("half turn: y against flipped y, correlation", _likeness(turned, flipped, 1)),
            Claim("half turn: HKS against flipped HKS, correlation", _likeness(turned, flipped, 3)),
            Claim("bend: edges, rms change of length", stretching(before.mesh, self.bent.mesh)),
            Claim("bend: vertices, mean move over diagonal", float(moved.mean() / diagonal)),
            Claim("bend: z of the vertices, correlation", _correlation(*depths)),
            Claim(
                "bend: HKS of the vertices, correlation", _correlation(before.hks, self.bent.hks)
            ),
            Claim("bend: image of z, correlation", _likeness(self.bent, before.images, 2)),
            Claim("bend: image of HKS, correlation", _likeness(self.bent, before.images, 3)),
            Claim("padding: largest step over largest inside the image", float(across / inside)),
        ]


def _likeness(pose: Pose, images: NDArray[np.float64], channel: int) -> float:
    return _correlation(pose.images[channel].ravel(), images[channel].ravel())


def _correlation(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    return float(np.corrcoef(one, other)[0, 1])


def _steps(images: NDArray[np.float64]) -> float:
    """Return the largest distance in space of neighbouring pixels of an image of positions."""
    return max(np.linalg.norm(np.diff(images, axis=axis), axis=0).max() for axis in (1, 2))


def compare(mesh: trimesh.Trimesh, parametrizer: Parametrizer, size: int) -> Properties:
    """Turn a shape, bend it, and make geometry images of each position from the beginning.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface with limbs.
    parametrizer : Parametrizer
    size : int
        Pixels along a side of the geometry images.

    Raises
    ------
    UnsupportedMesh
        The shape has no limbs to bend, or its map does not cover the sphere.
    """
    camera = principal_camera(np.asarray(mesh.vertices))
    seen = as_seen(mesh, camera)
    still = trimesh.Trimesh(seen, mesh.faces, process=False)
    original = _pose(still, parametrizer, size)
    turned = trimesh.Trimesh(seen * [-1, -1, 1], mesh.faces, process=False)
    return Properties(
        original,
        _pose(turned, parametrizer, size),
        _pose(bend(still, [0, 0, 1], _BEND), parametrizer, size, original),
    )


def _pose(
    mesh: trimesh.Trimesh, parametrizer: Parametrizer, size: int, like: Pose | None = None
) -> Pose:
    """Describe and map a shape; its sphere is turned as the mesh is seen, or like another."""
    spherical_map = SphericalMap(mesh, parametrizer.parametrize(mesh))
    if like is None:
        turn = facing(spherical_map, _camera(mesh))
    else:
        weights = vertex_shares(mesh)
        turn = Rotation.align_vectors(like.sphere, spherical_map.sphere, weights)[0]
    sphere = turn.apply(spherical_map.sphere)
    signature = HeatKernelSignature(times=_TIMES).describe(mesh, Operators(mesh))
    hks = signature[:, _TIMES // 2]
    channels = np.column_stack([mesh.vertices, hks])
    return Pose(mesh, sphere, hks, geometry_image(SphericalMap(mesh, sphere), channels, size))


def _camera(mesh: trimesh.Trimesh) -> Camera:
    """Look along z at the origin, y upward, as far as the mesh reaches."""
    reach = 1.06 * np.abs(np.asarray(mesh.vertices)[:, :2]).max()
    return Camera(np.zeros(3), np.array([0.0, 0, 1]), np.array([0.0, 1, 0]), float(reach))


def draw(properties: Properties) -> Figure:
    """Draw the half turn to the left, the bend in the middle, padding to the right."""
    figure = page(6 * _SIDE + 0.4, 3 * _SIDE + 0.9)
    parts = figure.subfigures(1, 3, squeeze=False, width_ratios=[2.1, 2.3, 1.1])
    left, centre, right = parts[0]
    _draw_turn(left.subplots(3, 2), properties)
    _draw_bend(centre.subplots(3, 2), properties)
    _draw_padding(right.subplots(3, 1), properties.original)
    for part, title in ((left, "a half turn"), (centre, "a bend"), (right, "padding")):
        part.suptitle(title, fontsize=12, color=INK)
    return figure


def _draw_turn(grid: NDArray[np.object_], properties: Properties) -> None:
    original, turned = properties.original, properties.turned
    size, square = original.images.shape[-1], pixels(_SIDE, _SIDE)
    again = reconstruct(original.images[:3])
    radius = 0.012 * _camera(original.mesh).half_height
    cut = Lines(cut_lines(original.spherical_map, Rotation.identity()), CUT, radius)
    shape = render([Surface(original.mesh)], _camera(original.mesh), square)
    panel(grid[0, 0], shape, "shape", f"{len(original.mesh.vertices)} vertices")
    # The cut is opened at the back, where the south pole is.
    behind = Camera(np.zeros(3), np.array([0.0, 0, -1]), np.array([0.0, 1, 0]), 84 * radius)
    picture = render([Surface(again), cut], behind, square)
    panel(grid[0, 1], picture, "from its image, from behind", f"{size} × {size}; the cut in red")
    for row, (channel, name) in enumerate(((1, "y"), (3, "HKS")), start=1):
        pair = (original.images[channel], turned.images[channel])
        for axes, image, title in zip(
            grid[row], _coloured(pair, signed=channel == 1), ("", ", shape turned"), strict=True
        ):
            panel(axes, image, name + title)
    values = {claim.claim: claim.value for claim in properties.claims()}
    for row, name in ((1, "y"), (2, "HKS")):
        figure = values[f"half turn: {name} against flipped {name}, correlation"]
        grid[row, 1].set_xlabel(f"against the flipped image: {figure:+.3f}", fontsize=8, color=INK)


def _draw_bend(grid: NDArray[np.object_], properties: Properties) -> None:
    poses = (properties.original, properties.bent)
    colours = _coloured([pose.hks for pose in poses])
    camera, square = _camera(properties.original.mesh), pixels(_SIDE, _SIDE)
    images = _coloured([pose.images[3] for pose in poses])
    for column, pose in enumerate(poses):
        title = ("HKS", "HKS, limbs bent")[column]
        picture = render([Surface(pose.mesh, colours[column])], camera, square)
        panel(grid[0, column], picture, title)
        panel(grid[1, column], images[column], "its image")
    original, bent = poses
    _scatter(grid[2, 0], original.mesh.vertices[:, 2], bent.mesh.vertices[:, 2], "z")
    _scatter(grid[2, 1], original.hks, bent.hks, "log HKS")


def _scatter(
    axes: Axes, before: NDArray[np.float64], after: NDArray[np.float64], name: str
) -> None:
    axes.plot(before, after, ".", ms=1.5, color=category(1), rasterized=True)
    ends = [min(before.min(), after.min()), max(before.max(), after.max())]
    axes.plot(ends, ends, color=INK, lw=0.6)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{name} of a vertex", fontsize=8, color=INK)
    axes.set_ylabel("bent", fontsize=8, color=INK)
    axes.tick_params(labelsize=7, colors=INK)
    axes.spines[["top", "right"]].set_visible(False)


def _draw_padding(column: Sequence[Axes], pose: Pose) -> None:
    size = pose.images.shape[-1]
    for axes, image, name in zip(column, pose.images[:3], "xyz", strict=True):
        (grid,) = _coloured([pad(image, size - 1)], signed=True)
        panel(axes, grid, f"{name}, 3 × 3")
        low, high = size - 1.5, 2 * size - 1.5
        axes.plot([low, high, high, low, low], [low, low, high, high, low], color=INK, lw=1.2)


def _coloured(
    fields: Sequence[NDArray[np.float64]], signed: bool = False
) -> list[NDArray[np.float64]]:
    """Colour several fields of values by one scale, about 0 if they are signed."""
    values = np.concatenate([field.ravel() for field in fields])
    colours = diverging(values, np.abs(values).max()) if signed else sequential(values)
    ends = np.cumsum([field.size for field in fields])[:-1]
    parts = np.split(colours, ends)
    return [part.reshape(*field.shape, 3) for part, field in zip(parts, fields, strict=True)]
