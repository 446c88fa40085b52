"""What is measured of a silhouette: 47 numbers that a motion or a size leaves as they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.baselines.light_field.outline import fourier_descriptors, length, resample, trace
from gipkg.compilation import compiled

RADIAL, ANGULAR = 3, 12
FOURIER = 10
CHORDS = 64
"""Points of an outline between which its length is measured: a staircase of pixels is longer
than the line that it stands for."""

COUNT = RADIAL * ANGULAR - 1 + FOURIER + 2
"""35 magnitudes of the angular radial transform, 10 Fourier descriptors, circularity and
eccentricity."""


def silhouette_features(image: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Measure a connected silhouette; (47,), between 0 and 1 up to the size of a pixel.

    The origin is the centroid of the silhouette, the unit of length its farthest pixel. The
    centre of the bounding box, which the original takes, depends on how the image is turned.
    """
    pixels = np.argwhere(image).astype(np.float64)
    centre = pixels.mean(axis=0)
    outline = trace(image)
    transform = np.abs(angular_radial_transform(pixels, centre)).ravel()
    perimeter = length(resample(outline, CHORDS))
    # The outline runs through the centres of its pixels, half a pixel inside the silhouette.
    area = max(len(pixels) - perimeter / 2, 1.0)
    circularity = 4 * np.pi * area / max(perimeter, 1.0) ** 2
    # Of a pixel itself, 1/12.
    moments = np.cov(pixels.T, bias=True) + np.eye(2) / 12
    smallest, largest = np.linalg.eigvalsh(moments)
    return np.concatenate(
        [
            transform[1:] / transform[0],
            fourier_descriptors(outline, centre, FOURIER),
            [min(circularity, 1.0), np.sqrt(smallest / largest)],
        ]
    )


def angular_radial_transform(
    pixels: NDArray[np.float64], centre: NDArray[np.float64], radius: float | None = None
) -> NDArray[np.complex128]:
    """Integrate the angular radial functions over a silhouette.

    V_nm(ρ, θ) = exp(imθ) R_n(ρ) / 2π with R_0 = 1 and R_n = 2 cos(πnρ) (Bober, "MPEG-7 Visual
    Shape Descriptors", IEEE Transactions on Circuits and Systems for Video Technology 11(6),
    2001).

    Parameters
    ----------
    pixels : (P, 2) float64 array
        Centres of the pixels.
    centre : (2,) float64 array
        Where ρ = 0.
    radius : float, optional
        Where ρ = 1; the farthest pixel by default.

    Returns
    -------
    (3, 12) complex128 array
        The integral of the conjugate of V_nm, n = 0, 1, 2, m = 0, …, 11.
    """
    offsets = pixels - centre
    if radius is None:
        radius = max(float(np.linalg.norm(offsets, axis=1).max()), 1.0)
    return _transform(offsets / radius) / (2 * np.pi * radius**2)


@compiled
def _transform(points):  # type: ignore[no-untyped-def]
    """Sum exp(-imθ) R_n(ρ) over points (P, 2)."""
    sums = np.zeros((RADIAL, ANGULAR), dtype=np.complex128)
    for p in range(len(points)):
        x, y = points[p, 0], points[p, 1]
        radius = np.sqrt(x * x + y * y)
        turn = complex(x, -y) / radius if radius > 0 else complex(0.0, 0.0)
        cosine = np.cos(np.pi * radius)
        angular = complex(1.0, 0.0)
        for m in range(ANGULAR):
            sums[0, m] += angular
            sums[1, m] += 2 * cosine * angular
            sums[2, m] += 2 * (2 * cosine * cosine - 1) * angular
            angular *= turn
    return sums
