"""One picture of what a stage makes: a mesh, a spherical map, a geometry image."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.images.lookup import geometry_image
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.cameras import principal_camera
from gipkg.reporting.colours import as_bytes, sequential
from gipkg.reporting.figures.appearance import FRONT, RoundSphere, shaded, turned_as_seen
from gipkg.reporting.rendering import Surface, render, render_mesh

Picture = NDArray[np.uint8]
"""(height, width, 3), red, green and blue."""

_DARKEST = 0.25
"""Least red, green or blue of a place: shades stay visible."""


def of_mesh(mesh: trimesh.Trimesh, size: int) -> Picture:
    """Draw a mesh, closed or not, seen along its thinnest axis: (size, size, 3).

    Where faces disagree about which side is outside, normals at vertices mean nothing, and every
    face has one shade.
    """
    smooth = mesh.is_watertight and mesh.is_winding_consistent
    return render_mesh(mesh, size=(size, size), smooth=smooth)


def of_map(spherical_map: SphericalMap, size: int) -> Picture:
    """Draw a mesh, its sphere and its geometry image: (size, 3 size, 3).

    A point has one colour in all three, from its place on the mesh and darkened by how the mesh
    turns away from the eye. The sphere is turned as the mesh is seen.
    """
    mesh = spherical_map.mesh
    camera = principal_camera(np.asarray(mesh.vertices))
    turned = turned_as_seen(spherical_map, camera)
    colours = shaded(mesh, _place_colours(np.asarray(mesh.vertices)), camera)
    grid = RoundSphere.of(turned)
    image = np.moveaxis(geometry_image(turned, colours, size), 0, -1)
    return np.hstack(
        [
            render([Surface(mesh, colours)], camera, (size, size)),
            render([Surface(grid.mesh(), grid.colours(colours))], FRONT, (size, size)),
            as_bytes(image),
        ]
    )


def of_image(image: NDArray[np.float64], size: int) -> Picture:
    """Draw a geometry image and its mesh where it shows positions, else its channels.

    Parameters
    ----------
    image : (C, n, n) float64 array
    size : int
        Height of the picture, and width of each of its panels, in pixels.
    """
    if len(image) == 3:
        mesh = reconstruct(image)
        places = _place_colours(np.moveaxis(image, 0, -1).reshape(-1, 3)).reshape(
            *image.shape[1:], 3
        )
        return np.hstack([_enlarged(places, size), of_mesh(mesh, size)])
    shades = (sequential(channel.ravel()).reshape(*channel.shape, 3) for channel in image)
    return np.hstack([_enlarged(channel, size) for channel in shades])


def _place_colours(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give places (N, 3) the colours (N, 3) of where they are in their bounding box."""
    low, extent = places.min(axis=0), np.ptp(places, axis=0)
    share = (places - low) / np.where(extent > 0, extent, 1.0)
    return _DARKEST + (1 - _DARKEST) * share


def _enlarged(colours: NDArray[np.float64], size: int) -> Picture:
    """Repeat or leave out the pixels of a square picture (n, n, 3), to (size, size, 3)."""
    chosen = (np.arange(size) * len(colours)) // size
    return as_bytes(colours[np.ix_(chosen, chosen)])
