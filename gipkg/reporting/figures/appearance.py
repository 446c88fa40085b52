"""How a shape and its sphere look in the figures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.images.lookup import PixelLookup, lookup
from gipkg.images.octahedron import pixel_directions
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.cameras import Camera, camera_on
from gipkg.reporting.colours import category
from gipkg.reporting.rendering import NEUTRAL
from gipkg.reporting.tips import Tips, vertex_shares


def sphere_camera(towards_eye: ArrayLike) -> Camera:
    """Look at the whole unit sphere, y upward."""
    axes = np.vstack([np.eye(3), -np.eye(3)])
    return replace(camera_on(axes, towards_eye, up=[0, 1, 0]), half_height=1.08)


FRONT, BACK = sphere_camera([0, 0, 1]), sphere_camera([0, 0, -1])
"""Two sides of the unit sphere."""


def tip_colours(tips: Tips) -> NDArray[np.float64]:
    """Give every tip a colour, and the rest none: (V, 3)."""
    colours = np.tile(NEUTRAL, (len(tips.region), 1))
    for tip in range(len(tips.vertex)):
        colours[tips.region == tip] = category(tip)
    return colours


def shaded(
    mesh: trimesh.Trimesh, colours: NDArray[np.float64], camera: Camera
) -> NDArray[np.float64]:
    """Darken colours (V, 3) by how a surface turns away from the eye.

    On the sphere and in the image, the shades show which part of the surface is where.
    """
    light = camera.towards_eye + 0.5 * camera.up
    facing = np.asarray(mesh.vertex_normals) @ (light / np.linalg.norm(light))
    return colours * (0.75 + 0.25 * facing[:, None])


@dataclass(frozen=True, slots=True)
class RoundSphere:
    """A sphere drawn by the pixels of a fine geometry image, so that it is round.

    The faces of a coarse map are chords; the grid's corners are on the sphere, and its edges
    run along those of the octahedron.
    """

    SIZE: ClassVar[int] = 257
    """Pixels along a side; odd, to have the octahedron's corners among them."""

    located: PixelLookup

    @classmethod
    def of(cls, spherical_map: SphericalMap) -> RoundSphere:
        """Locate the corners of the grid on a map."""
        return cls(lookup(spherical_map, cls.SIZE, Rotation.identity()))

    def mesh(self, positions: NDArray[np.float64] | None = None) -> trimesh.Trimesh:
        """Return the sphere, or other positions (n, n, 3) of the same grid."""
        grid = pixel_directions(self.SIZE) if positions is None else positions
        return reconstruct(np.moveaxis(grid, -1, 0))

    def colours(self, of_vertices: NDArray[np.float64]) -> NDArray[np.float64]:
        """Carry colours of the map's vertices (V, 3) over to those of :meth:`mesh`."""
        return np.asarray(reconstruct(self.located.render(of_vertices, np.float64)[0]).vertices)

    def face_colours(self, of_faces: NDArray[np.float64]) -> NDArray[np.float64]:
        """Carry colours of the map's faces (F, 3) over to the vertices of :meth:`mesh`."""
        return np.asarray(reconstruct(np.moveaxis(of_faces[self.located.face[0]], -1, 0)).vertices)


def as_seen(mesh: trimesh.Trimesh, camera: Camera) -> NDArray[np.float64]:
    """Turn the vertices (V, 3) as a camera sees them: x to the right, y upward, z to the eye.

    The centroid of the surface becomes the origin.
    """
    vertices = np.asarray(mesh.vertices)
    seen: NDArray[np.float64] = (vertices - vertex_shares(mesh) @ vertices) @ camera.axes.T
    return seen


def facing(spherical_map: SphericalMap, camera: Camera) -> Rotation:
    """Turn a sphere as its mesh is seen.

    It is the rotation that brings the sphere's points nearest to the mesh's, by area. As a cut
    it puts what the eye sees in the middle of the geometry image, the right way up.
    """
    mesh = spherical_map.mesh
    seen = as_seen(mesh, camera)
    return Rotation.align_vectors(seen, spherical_map.sphere, vertex_shares(mesh))[0]


def turned_as_seen(spherical_map: SphericalMap, camera: Camera) -> SphericalMap:
    """Return a map with its sphere turned by :func:`facing`."""
    turn = facing(spherical_map, camera)
    return SphericalMap(spherical_map.mesh, turn.apply(spherical_map.sphere))
