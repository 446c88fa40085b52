"""From an image of positions back to a closed mesh."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.images.seam import canonical_pixels


def reconstruct(image: NDArray[np.floating]) -> trimesh.Trimesh:
    """Connect the pixels of a geometry image of positions into a closed genus-0 mesh.

    Pixels that the cut identifies become one vertex, at their mean. Every square of four
    pixels becomes two triangles, split in the direction of the octahedron's edge in its
    quadrant; the connectivity depends on the image's size alone, so that all meshes of one
    size correspond.

    Parameters
    ----------
    image : (3, n, n) array
        x, y and z per pixel, n at least 3.

    Returns
    -------
    trimesh.Trimesh
        Oriented as the surface that the image was made of.

    Raises
    ------
    ValueError
        The image is none of positions, or has fewer than 3 x 3 pixels.
    """
    image = np.asarray(image, dtype=np.float64)
    if image.ndim != 3 or image.shape[0] != 3 or image.shape[1] != image.shape[2]:
        raise ValueError(f"the image is {image.shape}, it must be (3, n, n): x, y, z per pixel")
    size = image.shape[1]
    _, vertex = np.unique(canonical_pixels(size), return_inverse=True)
    positions = image.reshape(3, -1)
    counts = np.bincount(vertex.ravel())
    sums = np.stack([np.bincount(vertex.ravel(), coordinate) for coordinate in positions], axis=1)
    return trimesh.Trimesh(sums / counts[:, None], vertex.ravel()[_triangles(size)], process=False)


def _triangles(size: int) -> NDArray[np.int64]:
    """Pixel triples (F, 3), counterclockwise in an image with row 0 on top."""
    pixel = np.arange(size * size).reshape(size, size)
    upper_left, upper_right = pixel[:-1, :-1].ravel(), pixel[:-1, 1:].ravel()
    lower_left, lower_right = pixel[1:, :-1].ravel(), pixel[1:, 1:].ravel()
    middle = (size - 1) / 2
    below, right = (np.indices((size - 1, size - 1)) + 0.5 > middle).reshape(2, -1)
    rising = below == right  # from the lower left to the upper right
    first = (upper_left, lower_left, np.where(rising, upper_right, lower_right))
    second = (np.where(rising, lower_left, upper_left), lower_right, upper_right)
    triangles = np.stack([first, second], axis=-1).transpose(1, 2, 0).reshape(-1, 3)
    shared = canonical_pixels(size).ravel()[triangles]
    # With an even size, the middle square of each side has its two border pixels identified.
    collapsed = (shared == np.roll(shared, 1, axis=1)).any(axis=1)
    return triangles[~collapsed]
