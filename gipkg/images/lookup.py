"""From a spherical map to images: one lookup for a map and its cuts, any channels after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import DTypeLike, NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.images.location import locate
from gipkg.images.octahedron import pixel_directions
from gipkg.images.sampling import Sampling
from gipkg.images.seam import canonical_pixels
from gipkg.surfaces.validation import check_genus_zero


@dataclass(frozen=True, slots=True)
class PixelLookup:
    """Where on the mesh every pixel of K images of n x n pixels lies.

    Attributes
    ----------
    faces : (F, 3) integer array
        Of the mesh.
    face : (K, n, n) int32 array
        Face index of each pixel.
    weights : (K, n, n, 3) float64 array
        Barycentric weights of its corners, at least 0, sum 1.
    vertices : int
        V, the number of vertices of the mesh.
    """

    faces: NDArray[np.integer]
    face: NDArray[np.int32]
    weights: NDArray[np.float64]
    vertices: int

    @property
    def nearest(self) -> NDArray[np.integer]:
        """Vertex (K, n, n) of greatest weight at each pixel."""
        return self.faces[self.face, self.weights.argmax(axis=-1)]

    def render(self, channels: NDArray[np.floating], dtype: DTypeLike = np.float32) -> NDArray:
        """Interpolate per-vertex channels linearly within the faces.

        Pixels on the cut that show the same point get bit-equal values.

        Parameters
        ----------
        channels : (V, C) array
        dtype : dtype
            Of the result; the interpolation itself is in float64.

        Returns
        -------
        (K, C, n, n) array

        Raises
        ------
        ValueError
            The channels are not one row a vertex.
        """
        channels = np.asarray(channels, dtype=np.float64)
        if channels.ndim != 2 or len(channels) != self.vertices:
            raise ValueError(
                f"channels are {channels.shape}, they must be ({self.vertices}, C): "
                "one row a vertex of the mapped mesh"
            )
        pixels = self.face.size
        interpolation = sp.csr_array(
            (self.weights.ravel(), self.faces[self.face].ravel(), 3 * np.arange(pixels + 1)),
            shape=(pixels, self.vertices),
        )
        images = (interpolation @ channels).astype(dtype).reshape(*self.face.shape, -1)
        return np.ascontiguousarray(np.moveaxis(images, -1, 1))


def lookup(
    spherical_map: SphericalMap,
    size: int,
    cuts: Rotation,
    sampling: Sampling = "equal-area",
) -> PixelLookup:
    """Locate the pixels of one image per cut on a mapped mesh.

    Parameters
    ----------
    spherical_map : SphericalMap
        Covers the sphere; V vertices.
    size : int
        Pixels n along a side, at least 3.
    cuts : Rotation
        K rotations (or a single one, K = 1) applied to the sphere before it is cut.
    sampling : {"equal-area", "authors"}
        How the square wraps the sphere; see :data:`gipkg.images.sampling.Sampling`.

    Returns
    -------
    PixelLookup

    Raises
    ------
    UnsupportedMesh
        The mesh is not a closed genus-0 surface, or its map does not cover the sphere.
    ValueError
        There are fewer than 3 pixels along a side, or there is no such sampling.
    """
    mesh = spherical_map.mesh
    check_genus_zero(mesh)
    faces = np.asarray(mesh.faces)
    canonical = canonical_pixels(size).ravel()
    directions = pixel_directions(size, sampling).reshape(-1, 3)
    # A rotated sphere shows, at a pixel's direction, what was there before the rotation.
    inverse = cuts.inv().as_matrix().reshape(-1, 3, 3)
    rotated = np.einsum("kij,pj->kpi", inverse, directions[canonical]).reshape(-1, 3)
    face, weights, uncovered = locate(spherical_map.sphere, faces, rotated, size)
    if uncovered >= 0:
        raise UnsupportedMesh(
            f"no face of the spherical map covers the direction {rotated[uncovered]}: "
            "it is not a map of degree 1 onto the sphere; gipkg.parametrize gives one"
        )
    shape = (len(inverse), size, size)
    return PixelLookup(
        faces,
        # Which of two faces a pixel between them gets is decided once for both sides of the cut.
        face.reshape(len(inverse), -1)[:, canonical].reshape(shape),
        weights.reshape(len(inverse), -1, 3)[:, canonical].reshape(*shape, 3),
        len(mesh.vertices),
    )


def geometry_image(
    spherical_map: SphericalMap,
    channels: NDArray[np.floating],
    size: int = 56,
    cut: Rotation | None = None,
    sampling: Sampling = "equal-area",
) -> NDArray[np.float64]:
    """Make one geometry image; :func:`lookup` serves many cuts and channels at less cost.

    Parameters
    ----------
    spherical_map : SphericalMap
        V vertices.
    channels : (V, C) array
        For example the mesh's vertices, or ``gipkg.describe(mesh)``.
    size : int
        Pixels n along a side.
    cut : Rotation, optional
        Applied to the sphere before it is cut; none by default.
    sampling : {"equal-area", "authors"}

    Returns
    -------
    (C, n, n) float64 array

    Raises
    ------
    UnsupportedMesh, ValueError
        As :func:`lookup` and :meth:`PixelLookup.render`.
    """
    cuts = Rotation.identity() if cut is None else cut
    return lookup(spherical_map, size, cuts, sampling).render(channels, np.float64)[0]
